// The distance of a point from a triangle.
#pragma once

#include <array>

#include "isoatlas/volume.h"

namespace isoatlas {

using Corners3 = std::array<Vec3, 3>;  ///< of a triangle, in voxel coordinates

[[nodiscard]] double area_of(const Corners3& triangle);
/// To the nearest point of a triangle; it may be a segment or a point.
[[nodiscard]] double distance_to_triangle(const Vec3& point, const Corners3& triangle);

}  // namespace isoatlas
