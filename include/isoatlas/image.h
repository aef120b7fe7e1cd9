// Image: pixels of a picture, and files: PNG, APNG, GIF, WebP.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace isoatlas {

/// Red, green, blue, opacity of every pixel, 8 bits each, sRGB, not premultiplied. Row 0 is the top one, x runs fastest.
struct Image {
    std::int64_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< 4 * width * height

    Image() = default;
    Image(std::int64_t columns, std::int64_t rows) : width(columns), height(rows), rgba(4 * columns * rows) {}
    [[nodiscard]] std::uint8_t* at(std::int64_t x, std::int64_t y) { return &rgba[4 * (x + width * y)]; }
    [[nodiscard]] const std::uint8_t* at(std::int64_t x, std::int64_t y) const { return &rgba[4 * (x + width * y)]; }
    bool operator==(const Image&) const = default;
};

/// The bytes of a PNG file.
[[nodiscard]] std::vector<std::byte> encode_png(const Image& image);

struct Animation {
    std::vector<Image> frames;  ///< at least one, all of one size
    double frames_per_second = 12;
};

/// The bytes of an animation that is repeated for ever. GIF: at most 65535 x 65535 pixels, 256 colours for all frames, ordered dithering.
/// WebP: at most 16383 x 16383, quality 0..100, 100: lossless. Throws Error: usage (no frames, sizes, frames per second).
[[nodiscard]] std::vector<std::byte> encode_apng(const Animation& animation);
[[nodiscard]] std::vector<std::byte> encode_gif(const Animation& animation);
[[nodiscard]] std::vector<std::byte> encode_webp(const Animation& animation, double quality = 85);

/// Writes .gif, .png (APNG), .apng or .webp. Written to a temporary name and renamed. Throws Error: usage (unknown extension), resource.
void write_animation(const std::string& path, const Animation& animation);

/// Writes .png or .webp. Written to a temporary name and renamed. Throws Error: usage (unknown extension), resource.
void write_image(const std::string& path, const Image& image);

}  // namespace isoatlas
