// The chunks that PNG and APNG files consist of.
#pragma once

#include <span>
#include <vector>

#include "isoatlas/image.h"

namespace isoatlas {

struct PngChunks {
    std::vector<std::byte> bytes;

    /// Signature, IHDR, sRGB.
    void begin(std::int64_t width, std::int64_t height, bool with_alpha);
    void chunk(const char* name, std::span<const std::uint8_t> content);

private:
    void number(std::uint32_t value);
};

/// Big-endian.
void put_number(std::vector<std::uint8_t>& out, std::uint32_t value);
[[nodiscard]] bool has_transparency(const Image& image);
/// The content of IDAT.
[[nodiscard]] std::vector<std::uint8_t> deflated_pixels(const Image& image, bool with_alpha);

}  // namespace isoatlas
