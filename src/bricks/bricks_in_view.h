// Selects the bricks that a picture needs.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "field/brick_grid.h"
#include "isoatlas/samples_wanted.h"

namespace isoatlas {

/// Flags of the bricks with wanted samples. range: lowest and highest sample of a brick.
/// Cost: O(bricks * ranges).
[[nodiscard]] BrickFlags bricks_in_view(const BrickGrid& grid, const SamplesWanted& wanted,
                                        const std::function<std::array<double, 2>(BrickId)>& range);

}  // namespace isoatlas
