// Picture files against an independent reader: the pixels are those that were written.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "isoatlas/render.h"
#include "unit/formats/common/external.h"

namespace isoatlas {
namespace {

bool has_pillow() { return external::run("/usr/bin/python3 -c 'import PIL'").status == 0; }

std::string file(const std::string& name) {
    return (std::filesystem::path(testing::TempDir()) / (std::to_string(::getpid()) + "_" + name)).string();
}

/// Smooth colours, hard edges, noise and (asked for) transparency.
Image pattern(std::int64_t width, std::int64_t height, int shift, bool transparent) {
    Image image(width, height);
    for (std::int64_t y = 0; y < height; ++y) {
        for (std::int64_t x = 0; x < width; ++x) {
            std::uint8_t* p = image.at(x, y);
            p[0] = static_cast<std::uint8_t>(255 * x / width);
            p[1] = static_cast<std::uint8_t>(255 * y / height);
            p[2] = static_cast<std::uint8_t>((x + shift) / 8 % 2 == 0 ? 40 : 200);
            if (x < 10) p[2] = static_cast<std::uint8_t>(x * 7919 + y * 104729 + shift);
            p[3] = transparent ? static_cast<std::uint8_t>(x * 255 / width) : 255;
        }
    }
    return image;
}

/// The pixels of all frames as Pillow reads them, RGBA.
std::vector<std::uint8_t> read_back(const std::string& path) {
    const std::string raw = path + ".rgba";
    const external::Result result = external::python("from PIL import Image\ni = Image.open('" + path + "')\nout = open('" + raw +
                                                     "', 'wb')\nfor k in range(getattr(i, 'n_frames', 1)):\n    i.seek(k)\n    "
                                                     "out.write(i.convert('RGBA').tobytes())\n");
    EXPECT_EQ(result.status, 0) << result.text;
    std::ifstream in(raw, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::uint8_t> all_pixels(const Animation& animation) {
    std::vector<std::uint8_t> all;
    for (const Image& frame : animation.frames) all.insert(all.end(), frame.rgba.begin(), frame.rgba.end());
    return all;
}

double mean_difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(static_cast<int>(a[i]) - b[i]);
    return sum / static_cast<double>(a.size());
}

TEST(PictureFiles, PngKeepsEveryPixel) {
    if (!has_pillow()) GTEST_SKIP() << "python3-pil is not installed";
    for (const bool transparent : {false, true}) {
        for (const std::int64_t width : {1, 13, 200}) {
            const Image image = pattern(width, 57, 3, transparent);
            write_image(file("a.png"), image);
            EXPECT_EQ(read_back(file("a.png")), image.rgba) << width;
        }
    }
}

TEST(PictureFiles, ApngKeepsEveryPixelOfEveryFrame) {
    if (!has_pillow()) GTEST_SKIP() << "python3-pil is not installed";
    const Animation animation{.frames = {pattern(70, 40, 0, false), pattern(70, 40, 3, false), pattern(70, 40, 9, false)}};
    write_animation(file("a.apng"), animation);
    EXPECT_EQ(read_back(file("a.apng")), all_pixels(animation));
}

TEST(PictureFiles, GifIsNearEveryPixel) {
    if (!has_pillow()) GTEST_SKIP() << "python3-pil is not installed";
    // Large enough that the codes of the compression run out several times.
    const Animation animation{.frames = {pattern(300, 200, 0, false), pattern(300, 200, 3, false), pattern(300, 200, 3, false)}};
    write_animation(file("a.gif"), animation);
    const std::vector<std::uint8_t> read = read_back(file("a.gif"));
    ASSERT_EQ(read.size(), all_pixels(animation).size());
    EXPECT_LT(mean_difference(read, all_pixels(animation)), 8);
    // Few colours are kept but for the dithering.
    Animation flat{.frames = {Image(5, 5)}};
    for (std::size_t i = 0; i < flat.frames[0].rgba.size(); i += 4) {
        const std::uint8_t c = i % 8 == 0 ? 17 : 240;
        for (int k = 0; k < 4; ++k) flat.frames[0].rgba[i + k] = k == 3 ? 255 : c;
    }
    write_animation(file("flat.gif"), flat);
    EXPECT_EQ(read_back(file("flat.gif")), flat.frames[0].rgba);
}

TEST(PictureFiles, WebpIsReadBack) {
    if (!has_pillow()) GTEST_SKIP() << "python3-pil is not installed";
    const Animation animation{.frames = {pattern(70, 40, 0, false), pattern(70, 40, 3, false)}};
    const std::vector<std::byte> bytes = encode_webp(animation, 100);
    std::ofstream(file("a.webp"), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    EXPECT_EQ(read_back(file("a.webp")), all_pixels(animation)) << "quality 100 loses nothing";
    write_image(file("still.webp"), animation.frames[0]);
    EXPECT_LT(mean_difference(read_back(file("still.webp")), animation.frames[0].rgba), 8);
}

TEST(PictureFiles, TheSameBytesEveryTime) {
    const Animation animation{.frames = {pattern(90, 60, 0, true), pattern(90, 60, 3, true)}};
    EXPECT_EQ(encode_png(animation.frames[0]), encode_png(animation.frames[0]));
    EXPECT_EQ(encode_gif(animation), encode_gif(animation));
    EXPECT_EQ(encode_webp(animation), encode_webp(animation));
}

TEST(PictureFiles, RefusesWhatIsNoAnimation) {
    EXPECT_THROW(static_cast<void>(encode_gif({})), Error);
    EXPECT_THROW(static_cast<void>(encode_apng({.frames = {Image(3, 3), Image(3, 4)}})), Error);
    EXPECT_THROW(static_cast<void>(encode_webp({.frames = {Image(3, 3)}, .frames_per_second = 0})), Error);
    EXPECT_THROW(write_animation("a.mpg", {.frames = {Image(3, 3)}}), Error);
}

}  // namespace
}  // namespace isoatlas
