// The classes of whole bricks and of rows of a brick, as bits.
#pragma once

#include <functional>
#include <vector>

#include "bricks/brick_bits.h"
#include "bricks/brick_part.h"
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

/// Calls visit(brick) for each brick that shares a corner at least with this one.
template <class Visit>
void for_neighbours(const BrickGrid& grid, BrickId brick, const Visit& visit) {
    const Index3 place = grid.place(brick), begin = max(place - 1, {0, 0, 0}), end = min(place + 2, grid.size);
    for (std::int64_t z = begin[2]; z < end[2]; ++z) {
        for (std::int64_t y = begin[1]; y < end[1]; ++y) {
            for (std::int64_t x = begin[0]; x < end[0]; ++x) {
                const BrickId neighbour = grid.brick({x, y, z});
                if (neighbour != brick) visit(neighbour);
            }
        }
    }
}

/// Flags bricks that a chain of bricks with Highs joins with one of `homes`; in it, neighbours share a corner at least. An object of the
/// isovalue lies in the chains of its brick, so that it and all cells around it stay as they are where all other bricks count as Low.
/// Cost: O(bricks).
[[nodiscard]] BrickFlags joined_bricks(const BrickGrid& grid, const std::vector<BrickId>& homes, IdSpan<BrickId, const BrickClass> classes);

/// Where part of a grid is classified: bricks that are not kept are Low. kept: of the whole grid.
void make_others_low(const BrickPart& part, const BrickFlags& kept, IdArray<BrickId, BrickClass>& classes);

/// In ascending order; numbers of the whole grid.
[[nodiscard]] std::vector<BrickId> divided_bricks(const BrickPart& part, const LevelBricks& bricks);
/// The flagged bricks, in ascending order.
[[nodiscard]] std::vector<BrickId> flagged(IdSpan<BrickId, const std::uint8_t> flags);

/// Calls visit(brick) for all bricks, a layer at a time.
void for_bricks(const BrickGrid& grid, int threads, const std::function<void(BrickId)>& visit);

}  // namespace isoatlas
