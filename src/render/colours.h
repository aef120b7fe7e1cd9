// Colours: computed in linear light, stored as sRGB (IEC 61966-2-1).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/srgb.h"
#include "isoatlas/render.h"
#include "render/vectors.h"

namespace isoatlas {

inline Vec3 linear(const Colour& c) { return {to_linear(c.red), to_linear(c.green), to_linear(c.blue)}; }
inline std::uint8_t byte_of(double s) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(s, 0.0, 1.0))); }
/// One channel of linear light, encoded as sRGB.
inline std::uint8_t srgb_byte(double l) { return byte_of(to_srgb(std::clamp(l, 0.0, 1.0))); }

/// srgb_byte() without a power for each channel.
class SrgbEncoder {
public:
    static const SrgbEncoder& instance();
    [[nodiscard]] std::uint8_t byte(double light) const {
        const double inside = std::clamp(light, 0.0, 1.0);
        std::size_t found = first_[static_cast<std::size_t>(inside * kSteps)];
        while (inside >= least_[found + 1]) ++found;
        return static_cast<std::uint8_t>(found);
    }

private:
    SrgbEncoder();
    static constexpr std::size_t kSteps = 4096;
    std::array<double, 257> least_;               ///< the least light that has a byte; above 1 at the end
    std::array<std::uint8_t, kSteps + 1> first_;  ///< byte of the least light of each step
};

/// The background behind a picture, in linear light, `down` from 0 (top) to 1 (bottom).
Vec3 background_light(Background background, double down);
/// Colour of text and bars on it.
Colour ink_of(Background background);

}  // namespace isoatlas
