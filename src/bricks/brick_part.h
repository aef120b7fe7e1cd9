// A box of bricks as a grid of its own.
#pragma once

#include "field/brick_grid.h"

namespace isoatlas {

struct BrickPart {
    const BrickGrid& whole;
    std::array<std::int64_t, 3> first;   ///< brick
    std::array<std::int64_t, 3> origin;  ///< voxel
    BrickGrid grid;

    explicit BrickPart(const BrickGrid& all) : BrickPart(all, {{0, 0, 0}, all.size}) {}
    BrickPart(const BrickGrid& all, const Box& bricks)
        : whole(all), first(bricks.begin), origin(all.box(all.brick(bricks.begin)).begin), grid(extent_of(all, bricks)) {}
    /// Brick index in the whole grid.
    [[nodiscard]] std::int64_t number(std::int64_t brick) const {
        const std::array<std::int64_t, 3> at = grid.place(brick);
        return whole.brick({at[0] + first[0], at[1] + first[1], at[2] + first[2]});
    }

    /// Voxel index in the part of a voxel of the whole.
    [[nodiscard]] std::int64_t voxel(std::int64_t whole_voxel) const {
        const std::array<std::int64_t, 3> at = whole.extent.voxel(whole_voxel);
        return grid.extent.index(at[0] - origin[0], at[1] - origin[1], at[2] - origin[2]);
    }

private:
    static Extent extent_of(const BrickGrid& all, const Box& bricks) {
        const Box low = all.box(all.brick(bricks.begin)),
                  high = all.box(all.brick({bricks.end[0] - 1, bricks.end[1] - 1, bricks.end[2] - 1}));
        Extent extent = all.extent;
        for (int axis = 0; axis < 3; ++axis) extent.size[axis] = high.end[axis] - low.begin[axis];
        return extent;
    }
};

}  // namespace isoatlas
