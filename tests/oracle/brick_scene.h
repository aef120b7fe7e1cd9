// Volumes of a few bricks, as one bit a voxel, and the regions that grow in them, sample by sample.
#pragma once

#include <queue>
#include <vector>

#include "bricks/brick_bits.h"
#include "levelset/level_bricks.h"

namespace oracle {

using isoatlas::BrickBits, isoatlas::BrickClass, isoatlas::BrickFlags, isoatlas::BrickGrid, isoatlas::BrickId, isoatlas::Box,
    isoatlas::Extent, isoatlas::Index3, isoatlas::whole_brick;

/// A grid of a few bricks, with some samples of the other class than their surroundings.
struct Scene {
    BrickGrid grid;
    std::vector<bool> is_high;  ///< per voxel

    [[nodiscard]] bool contains(std::int64_t x, std::int64_t y, std::int64_t z) const {
        const Index3& size = grid.extent.size;
        return x >= 0 && y >= 0 && z >= 0 && x < size[0] && y < size[1] && z < size[2];
    }
    [[nodiscard]] bool at(std::int64_t x, std::int64_t y, std::int64_t z) const {
        return contains(x, y, z) && is_high[static_cast<std::size_t>(grid.extent.index(x, y, z))];
    }
    [[nodiscard]] BrickBits bits(BrickId brick) const {
        const Box box = grid.box(brick);
        BrickBits bits{};
        for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
            for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) {
                for (std::int64_t x = box.begin[0]; x < box.end[0]; ++x) {
                    const auto row = static_cast<std::size_t>(y - box.begin[1] + 8 * (z - box.begin[2]));
                    if (at(x, y, z)) bits[row] |= static_cast<std::uint16_t>(1 << (x - box.begin[0]));
                }
            }
        }
        return bits;
    }
    [[nodiscard]] BrickClass class_of(BrickId brick) const {
        const BrickBits own = bits(brick);
        return own == whole_brick(grid.box(brick).size()) ? BrickClass::high : own == BrickBits{} ? BrickClass::low : BrickClass::divided;
    }
};

/// Sample by sample: the voxels of the region, and their neighbours.
inline std::vector<bool> region_and_neighbours(const Scene& scene, const std::vector<Index3>& seeds) {
    const Extent& extent = scene.grid.extent;
    std::vector<bool> near(scene.is_high.size(), false), reached = near;
    std::queue<Index3> pending;
    const auto reach = [&](const Index3& at) {
        const auto voxel = static_cast<std::size_t>(extent.index(at));
        near[voxel] = true;
        if (!scene.is_high[voxel] || reached[voxel]) return;
        reached[voxel] = true;
        pending.push(at);
    };
    for (const Index3& seed : seeds) reach(seed);
    for (; !pending.empty(); pending.pop()) {
        const Index3 begin = max(pending.front() - 1, {0, 0, 0}), end = min(pending.front() + 2, extent.size);
        for (std::int64_t z = begin[2]; z < end[2]; ++z) {
            for (std::int64_t y = begin[1]; y < end[1]; ++y) {
                for (std::int64_t x = begin[0]; x < end[0]; ++x) reach({x, y, z});
            }
        }
    }
    return near;
}

/// Flags the bricks that they lie in, unless these are Low.
inline BrickFlags bricks_of_region(const Scene& scene, const std::vector<Index3>& seeds) {
    const BrickGrid& grid = scene.grid;
    const std::vector<bool> near = region_and_neighbours(scene, seeds);
    BrickFlags bricks(static_cast<std::size_t>(grid.count()), 0);
    for (std::int64_t voxel = 0; voxel < grid.extent.voxels(); ++voxel) {
        if (near[static_cast<std::size_t>(voxel)]) bricks[grid.brick(BrickGrid::place_of(grid.extent.voxel(voxel)))] = 1;
    }
    for (const BrickId b : bricks.ids()) {
        if (scene.class_of(b) == BrickClass::low) bricks[b] = 0;
    }
    return bricks;
}

}  // namespace oracle
