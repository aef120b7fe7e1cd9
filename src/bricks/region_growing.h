// Region growing, brick by brick: which bricks does an object enter, when the samples of a brick cost a read?
//
// Samples are neighbours if they differ by at most one along each axis. That joins all Highs that a cell joins, and others, so that the
// grown region contains the object whole. Seeds are Highs; a brick that the region enters from another one is needed, and read, if it is
// divided. In the literature: seeded region growing (Adams, Bischof, 1994).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bricks/brick_bits.h"
#include "levelset/level_bricks.h"

namespace isoatlas {

/// Bits of the samples of a brick and of one sample around it: bit x + 1 of row (y + 1) + 10 (z + 1).
using BrickBitsAround = std::array<std::uint32_t, static_cast<std::size_t>((kBrickSize[1] + 2) * (kBrickSize[2] + 2))>;
/// The samples of `bits`, and all their neighbours.
[[nodiscard]] BrickBitsAround with_neighbours(const BrickBits& bits);

class RegionGrowing {
public:
    /// Both must live as long as this. Cost: 9 bytes a brick.
    RegionGrowing(const BrickGrid& grid, IdSpan<BrickId, const BrickClass> classes);

    /// Starts at a voxel; nothing happens where it is Low.
    void seed(const Index3& voxel);
    /// Grows through all bricks whose samples are known. Returns the divided bricks that the region touches and that are missing, in
    /// ascending order; none: the region is complete.
    [[nodiscard]] std::vector<BrickId> grow();
    /// Adds divided bricks around some that are missing, the nearest first, until there are `count` or no more are joined with them: a few
    /// long reads take less time than many short ones. Ascending order.
    void extend(std::vector<BrickId>& missing, std::int64_t count) const;
    /// The samples of a divided brick.
    void add(BrickId brick, const BrickBits& high);
    /// Flags the bricks with samples of the region, and the divided ones that have samples beside it.
    [[nodiscard]] const BrickFlags& touched() const { return touched_; }

private:
    struct Brick {
        BrickId id;
        bool is_known = false;    ///< its samples are
        bool is_pending = false;  ///< in pending_
        BrickBits high{}, reached{};
    };
    Brick& brick_of(BrickId id);
    /// Reaches the Highs among some samples of a brick.
    void reach(BrickId id, const BrickBits& samples);
    void reach_known(Brick& brick, const BrickBits& samples);
    void spread(const Brick& from);

    const BrickGrid& grid_;
    IdSpan<BrickId, const BrickClass> classes_;
    BrickFlags touched_;
    IdArray<BrickId, std::int64_t> number_;  ///< in bricks_; -1: not there
    std::vector<Brick> bricks_;
    std::vector<std::int64_t> pending_;  ///< numbers of bricks with samples that were reached and whose neighbours were not visited
    std::vector<BrickId> missing_;
};

}  // namespace isoatlas
