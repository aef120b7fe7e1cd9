// The classes of whole bricks and of rows of a brick, as bits.
#pragma once

#include <functional>
#include <vector>

#include "bricks/brick_bits.h"
#include "levelset/high_bits.h"
#include "levelset/level_bricks.h"

namespace isoatlas {

/// Sets bits [p, p + 16) of a row of classes; positions as in HighBits.
inline void put_bits(std::uint64_t* row, std::int64_t p, std::uint64_t bits) {
    row[p / 64] |= bits << p % 64;
    if (p % 64 > 48) row[p / 64 + 1] |= bits >> (64 - p % 64);
}

/// Flags bricks that are entirely High or Low and adjacent to a brick of another class or, if High, at the border of the grid.
[[nodiscard]] BrickFlags touching_others(const BrickGrid& grid, IdSpan<BrickId, const BrickClass> classes);

/// Does the halo of a brick (bricks/brick_surroundings.h) contain samples of the other class? sides: of the divided bricks.
[[nodiscard]] bool touches_surface(const HighBits& high, const LevelBricks& bricks, IdSpan<BrickId, const BrickFaces> sides, BrickId brick);
/// All such bricks.
[[nodiscard]] std::vector<BrickId> beside_surface(const HighBits& high, const LevelBricks& bricks, IdSpan<BrickId, const BrickFaces> sides,
                                                  int threads);

/// The flags of bricks, and of those around them; outside: those of what lies beyond the ends of the grid.
[[nodiscard]] BrickFlags with_halo(const BrickGrid& grid, BrickFlags flags, std::uint8_t outside = 0);

/// Makes bricks Low that no chain of bricks with Highs joins with one of `homes`; in it, neighbours share a corner at least. An object of
/// the isovalue lies in the chains of its brick, so that it and all cells around it stay as they are. Cost: O(bricks).
void keep_joined(const BrickGrid& grid, const std::vector<BrickId>& homes, IdArray<BrickId, BrickClass>& classes);

/// The flagged bricks, in ascending order.
[[nodiscard]] std::vector<BrickId> flagged(IdSpan<BrickId, const std::uint8_t> flags);

/// Calls visit(brick) for all bricks, a layer at a time.
void for_bricks(const BrickGrid& grid, int threads, const std::function<void(BrickId)>& visit);

}  // namespace isoatlas
