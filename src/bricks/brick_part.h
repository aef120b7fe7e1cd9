// A box of bricks as a grid of its own.
#pragma once

#include "field/brick_grid.h"

namespace isoatlas {

struct BrickPart {
    const BrickGrid& whole;
    Index3 first;   ///< brick
    Index3 origin;  ///< voxel
    BrickGrid grid;

    explicit BrickPart(const BrickGrid& all) : BrickPart(all, {{0, 0, 0}, all.size}) {}
    BrickPart(const BrickGrid& all, const Box& bricks)
        : whole(all), first(bricks.begin), origin(all.box(all.brick(bricks.begin)).begin), grid(extent_of(all, bricks)) {}
    /// Of a brick of the part: its number in the whole grid.
    [[nodiscard]] BrickId number(BrickId brick) const { return whole.brick(grid.place(brick) + first); }

    /// Voxel index in the part of a voxel of the whole.
    [[nodiscard]] VoxelId voxel(VoxelId whole_voxel) const {
        return VoxelId(grid.extent.index(whole.extent.voxel(whole_voxel.number()) - origin));
    }

private:
    static Extent extent_of(const BrickGrid& all, const Box& bricks) {
        const Box low = all.box(all.brick(bricks.begin)), high = all.box(all.brick(bricks.end - 1));
        return {all.extent.rank, high.end - low.begin};
    }
};

}  // namespace isoatlas
