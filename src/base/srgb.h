// sRGB (IEC 61966-2-1) and the colours of objects.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace isoatlas {

inline double to_linear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }
inline double to_srgb(double l) { return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055; }

using SrgbBytes = std::array<std::uint8_t, 3>;

/// Distinguishable by any kind of colour vision (after Okabe and Ito, 2008), the first one that of bone; repeats after 7.
inline SrgbBytes object_colour(std::int64_t i) {
    constexpr std::array<SrgbBytes, 7> kColours{
        {{230, 216, 186}, {86, 180, 233}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {0, 114, 178}}};
    return kColours[static_cast<std::size_t>((i % 7 + 7) % 7)];
}

}  // namespace isoatlas
