// Edge collapses in one block of a surface: what lies in it as a whole changes, what reaches into it stays.
#pragma once

#include <cstdint>

#include "base/cancel.h"
#include "level_of_detail/block_grid.h"
#include "level_of_detail/rules.h"

namespace isoatlas {

struct CollapseLimits {
    double max_cost = 0;         ///< quadric error: area times squared distance
    std::int64_t triangles = 0;  ///< of the block: not fewer
};

/// Collapses edges between points that are not locked, cheapest first, as long as one can be. Returns how many triangles disappeared.
std::int64_t collapse_block(SurfaceState& state, const SurfaceBlock& block, const CollapseLimits& limits, const CallerLooks& stop_if_asked);

}  // namespace isoatlas
