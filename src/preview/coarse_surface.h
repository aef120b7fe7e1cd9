// Simplified surfaces for small pictures and previews, by vertex clustering.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/surface.h"

namespace isoatlas {

/// Corners of at most `max` of the given triangles, three each. positions: three numbers a point. Components smaller than a cluster
/// vanish. Cost: O(points + triangles).
[[nodiscard]] std::vector<unsigned> fewer_triangles(std::span<const unsigned> corners, std::span<const float> positions, std::size_t max);

/// Reduces a surface of a 3D volume to at most `max` triangles; unchanged if it has no more. Fewer than 2^32 points.
[[nodiscard]] Surface coarse_surface(Surface surface, std::size_t max);

}  // namespace isoatlas
