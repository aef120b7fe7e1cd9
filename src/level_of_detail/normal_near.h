// Normals of new points: those of the original surface at the nearest place.
#pragma once

#include <array>
#include <span>

#include "level_of_detail/original.h"

namespace isoatlas {

/// The normal at a point beside the surface: that of its nearest triangle there, between those of its corners. step: a guess of how far the
/// surface is. normals: of the points of the surface.
[[nodiscard]] std::array<float, 3> normal_near(const OriginalSurface& original, std::span<const std::array<float, 3>> normals,
                                               const Vec3& p, double step);

}  // namespace isoatlas
