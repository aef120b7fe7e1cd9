#include "formats/volume/pixel_choice.h"

#include <array>
#include <cstring>
#include <type_traits>

#include "base/check.h"
#include "formats/volume/choose.h"

namespace isoatlas {
namespace {

constexpr std::array<const char*, 5> kColourChannels = {"red", "green", "blue", "luminance", "index"};
constexpr int kLuminance = 3, kIndex = 4;
constexpr std::array<std::int64_t, 3> kWeights = {19595, 38470, 7471};  // of red, green and blue, ITU-R BT.601; their sum is 2^16
constexpr int kWeightBits = 16;

/// What of a pixel can be chosen: its samples, of a colour its luminance, too.
int choices_in(const PixelKind& kind) {
    if (!kind.is_rgb) return kind.values();
    return kind.has_index ? kIndex + 1 : kLuminance + 1;
}

std::string name_of_channel(const std::vector<std::string>& planes, std::size_t plane, int choice, const PixelKind& kind) {
    if (choices_in(kind) == 1) return planes[plane];
    std::string colour = kind.is_rgb ? kColourChannels[static_cast<std::size_t>(choice)] : "";
    if (planes.size() == 1) return colour;
    const std::string name = planes[plane].empty() ? std::to_string(plane) : planes[plane];
    return name + " " + (colour.empty() ? std::to_string(choice) : colour);
}

template <class T>
T luminance(const T* pixel) {
    if constexpr (std::is_floating_point_v<T>) {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) sum += static_cast<double>(kWeights[i]) / (1 << kWeightBits) * static_cast<double>(pixel[i]);
        return static_cast<T>(sum);
    } else {
        std::int64_t sum = 1 << (kWeightBits - 1);
        for (std::size_t i = 0; i < 3; ++i) sum += kWeights[i] * static_cast<std::int64_t>(pixel[i]);
        return static_cast<T>(sum >> kWeightBits);
    }
}

}  // namespace

ChannelChoice choose_pixels(const std::string& path, const OpenOptions& options, const std::vector<std::string>& planes,
                            const PixelKind& kind, VolumeInfo& info) {
    const int each = choices_in(kind);
    std::vector<std::string> names;
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        for (int choice = 0; choice < each; ++choice) names.push_back(name_of_channel(planes, plane, choice, kind));
    }
    if (kind.alphas > 0) info.notes.emplace_back("the transparency (alpha) of the pixels is ignored");
    std::int64_t channel = kLuminance;
    if (kind.is_rgb && planes.size() == 1 && !options.channel)
        info.notes.push_back(std::string("the pixels are colours: their luminance is read; a channel chooses red, green or blue") +
                             (kind.has_index ? ", or their index in the colour table" : ""));
    else
        channel = choose_channel(path, options, names);
    info.volumes.channel = channel;
    if (names.size() > 1 || !names[0].empty()) info.volumes.channels = std::move(names);
    const auto choice = static_cast<int>(channel % each);
    const bool is_luminance = kind.is_rgb && choice == kLuminance;
    const int sample = !kind.is_rgb || choice < kLuminance ? choice : is_luminance ? 0 : kIndex - 1;
    return {.plane = channel / each, .pixel = {.sample = sample, .is_luminance = is_luminance}};
}

void take_values(std::span<const std::byte> pixels, int samples, ValueType type, const PixelChoice& choice, std::span<std::byte> out) {
    visit_type(type, [&]<class T>(T) {
        const std::size_t count = out.size() / sizeof(T), step = static_cast<std::size_t>(samples) * sizeof(T);
        ISOATLAS_CHECK(pixels.size() >= count * step && choice.sample < samples);
        const std::byte* from = pixels.data() + static_cast<std::size_t>(choice.sample) * sizeof(T);
        std::byte* to = out.data();
        for (std::size_t i = 0; i < count; ++i, from += step, to += sizeof(T)) {
            if (!choice.is_luminance) {
                std::memcpy(to, from, sizeof(T));
                continue;
            }
            std::array<T, 3> colour{};
            std::memcpy(colour.data(), from, sizeof colour);
            const T value = luminance(colour.data());
            std::memcpy(to, &value, sizeof(T));
        }
    });
}

}  // namespace isoatlas
