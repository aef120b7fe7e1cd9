// A surface in blocks, which can be simplified at the same time: no triangle within one meets a triangle within another.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/triangle_tree.h"
#include "level_of_detail/rules.h"

namespace isoatlas {

class BlockGrid {
public:
    using Place = std::array<std::int64_t, 3>;

    /// Cubes of this edge that fill `box` and begin `shift` before it, 0 to edge; an infinite edge: one block.
    BlockGrid(const BoundingBox& box, double edge, double shift);

    [[nodiscard]] std::int64_t blocks() const { return count_[0] * count_[1] * count_[2]; }
    /// The block in which a point lies; points outside the box lie in no block. Ascends with each coordinate: points between two points of
    /// a block lie in it.
    [[nodiscard]] Place of(const Vec3& p) const {
        if (std::isinf(edge_)) return {};
        Place block{};
        for (std::size_t axis = 0; axis < 3; ++axis) block[axis] = static_cast<std::int64_t>(std::floor((p[axis] - low_[axis]) / edge_));
        return block;
    }
    [[nodiscard]] std::size_t number(const Place& block) const {
        return static_cast<std::size_t>((block[2] * count_[1] + block[1]) * count_[0] + block[0]);
    }

private:
    Vec3 low_;
    double edge_;
    Place count_{};
};

struct SurfaceBlock {
    const BlockGrid* grid = nullptr;  ///< null: the block is a box
    BlockGrid::Place place{};
    BoundingBox box{};
    std::vector<std::uint32_t> inside;    ///< triangles whose points lie in the block
    std::vector<std::uint32_t> crossing;  ///< triangles that reach into the block and beyond
    [[nodiscard]] bool holds(const Vec3& p) const { return grid ? grid->of(p) == place : box.squared_distance(p) == 0; }
};

/// The blocks that have triangles; the points of triangles that reach beyond their block become locked. The grid must live as long.
[[nodiscard]] std::vector<SurfaceBlock> blocks_of(SurfaceState& state, const BlockGrid& grid);

}  // namespace isoatlas
