// Surfaces with fewer triangles, for small pictures and first looks: points that are close become one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/surface.h"

namespace isoatlas {

/// Corners of at most so many triangles of those given, three each. positions: three numbers a point. Parts that are smaller than a
/// cluster vanish. Cost: O(points + triangles).
[[nodiscard]] std::vector<unsigned> fewer_triangles(std::span<const unsigned> corners, std::span<const float> positions, std::size_t max);

/// A surface of a 3D volume with at most so many triangles; as it is, where it has no more. Fewer than 2^32 points.
[[nodiscard]] Surface coarse_surface(Surface surface, std::size_t max);

}  // namespace isoatlas
