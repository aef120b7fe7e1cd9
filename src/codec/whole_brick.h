// Numbers of a brick of the full size, 16 x 8 x 8, from their stored differences: disarrange() and undo_differences() (differences.h) where
// every length is known to the compiler.
#pragma once

#include <span>

#include "codec/differences.h"
#include "field/brick_grid.h"

namespace isoatlas {

/// The same numbers as disarrange() and undo_differences() restore for size kBrickSize. `arranged` is overwritten. Both have kBrickSamples
/// numbers.
template <class N>
void restore_whole_brick(std::span<N> arranged, const Orders& orders, std::span<N> out);

}  // namespace isoatlas
