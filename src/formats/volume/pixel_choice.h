// What is read of pixels with several samples: one of them, or the luminance of a colour.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

struct PixelChoice {
    int sample = 0;             ///< from 0; of colours: red, green, blue
    bool is_luminance = false;  ///< of the samples 0 to 2, instead of one of them
};

/// The samples of a pixel, interleaved.
struct PixelKind {
    int samples = 1;         ///< with alpha
    int alphas = 0;          ///< the last of them, which are never read
    bool is_rgb = false;     ///< the first three are red, green and blue
    bool has_index = false;  ///< the colours are of a table; a fourth sample, the last, is their index in it
    [[nodiscard]] int values() const { return samples - alphas; }
    bool operator==(const PixelKind&) const = default;
};

struct ChannelChoice {
    std::int64_t plane = 0;  ///< among the channels whose pixels are apart
    PixelChoice pixel;
};

/// options.channel among channels whose pixels are apart (`planes`: their names, at least one) and the samples of their pixels. A colour
/// has the channels red, green, blue, luminance, and index where it has one. Unset: the only one, or the luminance of the only colour, with
/// a note. Sets info.volumes. Throws Error{usage} as choose_channel().
[[nodiscard]] ChannelChoice choose_pixels(const std::string& path, const OpenOptions& options, const std::vector<std::string>& planes,
                                          const PixelKind& kind, VolumeInfo& info);

/// One value of each pixel: out.size() / size_of(type) pixels of `samples` samples each in host byte order. Luminance: 0.299 red + 0.587
/// green + 0.114 blue in 16 bits after the point, of integers rounded to the nearest.
void take_values(std::span<const std::byte> pixels, int samples, ValueType type, const PixelChoice& choice, std::span<std::byte> out);

}  // namespace isoatlas
