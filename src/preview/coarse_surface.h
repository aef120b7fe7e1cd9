// Simplified surfaces for small pictures, by vertex clustering.
#pragma once

#include <cstddef>

#include "isoatlas/surface.h"

namespace isoatlas {

/// Reduces a surface of a 3D volume to at most `max` triangles; unchanged if it has no more. Fewer than 2^32 points. Components smaller
/// than a cluster vanish. Cost: O(points + triangles).
[[nodiscard]] Surface coarse_surface(Surface surface, std::size_t max);

}  // namespace isoatlas
