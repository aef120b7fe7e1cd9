// Channels of pixels with several samples, and the values that are read of them.
#include "formats/volume/pixel_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

using Names = std::vector<std::string>;

struct Chosen {
    ChannelChoice choice;
    VolumeInfo info;
};

Chosen choose(const PixelKind& kind, std::optional<std::string> channel = {}, const Names& planes = {""}) {
    OpenOptions options;
    options.channel = std::move(channel);
    Chosen chosen;
    chosen.choice = choose_pixels("v.tif", options, planes, kind, chosen.info);
    return chosen;
}

bool says(const Chosen& chosen, const std::string& word) {
    return std::ranges::any_of(chosen.info.notes, [&](const std::string& note) { return note.find(word) != std::string::npos; });
}

constexpr PixelKind kColour{.samples = 3, .is_rgb = true}, kColourAndAlpha{.samples = 4, .alphas = 1, .is_rgb = true},
    kTable{.samples = 4, .is_rgb = true, .has_index = true};

TEST(PixelChoice, OneSampleIsNoChoice) {
    const Chosen grey = choose({});
    EXPECT_EQ(grey.choice.pixel.sample, 0);
    EXPECT_FALSE(grey.choice.pixel.is_luminance);
    EXPECT_TRUE(grey.info.volumes.channels.empty());
    EXPECT_TRUE(grey.info.notes.empty());
    EXPECT_TRUE(says(choose({.samples = 2, .alphas = 1}), "alpha"));
}

TEST(PixelChoice, ColoursAreReadAsLuminanceUnlessAChannelIsChosen) {
    const Chosen colour = choose(kColour);
    EXPECT_TRUE(colour.choice.pixel.is_luminance);
    EXPECT_EQ(colour.info.volumes.channels, (Names{"red", "green", "blue", "luminance"}));
    EXPECT_EQ(colour.info.volumes.channel, 3);
    EXPECT_TRUE(says(colour, "luminance"));
    const Names names = {"red", "green", "blue"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        for (const std::string& word : {names[i], std::to_string(i)}) {
            const Chosen one = choose(kColourAndAlpha, word);
            EXPECT_EQ(one.choice.pixel.sample, static_cast<int>(i));
            EXPECT_FALSE(one.choice.pixel.is_luminance);
            EXPECT_TRUE(says(one, "alpha"));
        }
    }
    EXPECT_TRUE(choose(kColour, "luminance").choice.pixel.is_luminance);
    EXPECT_THROW((void)choose(kColour, "index"), Error);
    EXPECT_THROW((void)choose(kColour, "4"), Error);
}

TEST(PixelChoice, TheIndexOfAColourTableIsAChannel) {
    const Chosen index = choose(kTable, "index");
    EXPECT_EQ(index.choice.pixel.sample, 3);
    EXPECT_FALSE(index.choice.pixel.is_luminance);
    EXPECT_TRUE(choose(kTable).choice.pixel.is_luminance);
    EXPECT_TRUE(says(choose(kTable), "index"));
}

TEST(PixelChoice, PlanesTimesSamples) {
    EXPECT_EQ(choose({}, "GFP", {"DAPI", "GFP"}).choice.plane, 1);
    const Chosen sample = choose({.samples = 2}, "GFP 1", {"DAPI", "GFP"});
    EXPECT_EQ(sample.choice.plane, 1);
    EXPECT_EQ(sample.choice.pixel.sample, 1);
    EXPECT_EQ(sample.info.volumes.channels, (Names{"DAPI 0", "DAPI 1", "GFP 0", "GFP 1"}));
    const Chosen colour = choose(kColour, "1 blue", {"", ""});
    EXPECT_EQ(colour.choice.plane, 1);
    EXPECT_EQ(colour.choice.pixel.sample, 2);
    EXPECT_THROW((void)choose({}, {}, {"DAPI", "GFP"}), Error) << "which one?";
    EXPECT_THROW((void)choose(kColour, {}, {"DAPI", "GFP"}), Error);
}

template <class T>
std::vector<T> take(const std::vector<T>& pixels, int samples, const PixelChoice& choice) {
    std::vector<T> out(pixels.size() / static_cast<std::size_t>(samples));
    take_values(std::as_bytes(std::span(pixels)), samples, value_type_of<T>, choice, std::as_writable_bytes(std::span(out)));
    return out;
}

TEST(PixelChoice, ValuesOfPixels) {
    const std::vector<std::uint16_t> pixels = {1, 2, 3, 4, 10, 20, 30, 40};
    for (int sample = 0; sample < 4; ++sample) {
        const auto first = static_cast<std::uint16_t>(sample + 1);
        EXPECT_EQ(take(pixels, 4, {.sample = sample}), (std::vector<std::uint16_t>{first, static_cast<std::uint16_t>(10 * first)}));
    }
}

TEST(PixelChoice, LuminanceIsRoundedToTheNearest) {
    for (int value = 0; value <= 255; ++value) {  // grey stays grey
        const auto grey = static_cast<std::uint8_t>(value);
        EXPECT_EQ(take<std::uint8_t>({grey, grey, grey}, 3, {.is_luminance = true}), (std::vector{grey}));
    }
    const auto largest = std::numeric_limits<std::int32_t>::max(), least = std::numeric_limits<std::int32_t>::min();
    EXPECT_EQ(take<std::int32_t>({largest, largest, largest, least, least, least}, 3, {.is_luminance = true}),
              (std::vector<std::int32_t>{largest, least}));
    for (int red = 0; red <= 255; red += 15) {
        for (int green = 0; green <= 255; green += 15) {
            for (int blue = 0; blue <= 255; blue += 15) {
                const double right = 0.299 * red + 0.587 * green + 0.114 * blue;
                const std::vector<std::uint8_t> pixel = {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
                                                         static_cast<std::uint8_t>(blue)};
                EXPECT_NEAR(take(pixel, 3, {.is_luminance = true})[0], right, 0.505);
            }
        }
    }
    EXPECT_NEAR(take<float>({1, 0, 0, 0, 1, 0}, 3, {.is_luminance = true})[0], 0.299, 1e-5);
    EXPECT_NEAR(take<double>({0, 1e300, 0}, 3, {.is_luminance = true})[0], 0.587e300, 1e295);
}

}  // namespace
}  // namespace isoatlas
