// Colours: computed in linear light, stored as sRGB (IEC 61966-2-1).
#pragma once

#include <algorithm>
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

/// The background behind a picture, in linear light, `down` from 0 (top) to 1 (bottom).
Vec3 background_light(Background background, double down);
/// Colour of text and bars on it.
Colour ink_of(Background background);

}  // namespace isoatlas
