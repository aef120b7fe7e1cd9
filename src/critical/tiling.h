// Cutting a grid into boxes: parts with little surface, each small enough to be worked on in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "field/order.h"

namespace isoatlas {

class Tiling {
public:
    /// Boxes of `side` voxels along y and z, kLonger times as many along x: rows are contiguous in memory, and a box of short rows brings
    /// much into memory that is not its own.
    Tiling(const Extent& extent, std::int64_t side) : extent_(extent), side_{kLonger * side, side, side} {
        for (int a = 0; a < 3; ++a) tiles_[a] = (extent.size[a] + side_[a] - 1) / side_[a];
    }
    static constexpr std::int64_t kLonger = 4;  // a fifth more surface than a cube
    [[nodiscard]] std::int64_t count() const { return tiles_.product(); }
    [[nodiscard]] std::int64_t side(int axis) const { return side_[axis]; }
    [[nodiscard]] std::int64_t tile_of_voxel(std::int64_t voxel) const {
        const std::int64_t row = voxel / extent_.size[0], x = voxel % extent_.size[0];
        return x / side_[0] + tiles_[0] * (row % extent_.size[1] / side_[1] + tiles_[1] * (row / extent_.size[1] / side_[2]));
    }
    /// The tile of the voxel that owns an element.
    [[nodiscard]] std::int64_t tile_of(ElementCode code) const {
        return tile_of_voxel(code.is_body() ? code.cell() : code.kind() == CodeKind::face ? code.index() / 3 : code.index());
    }
    /// The first voxel of a tile, and the one behind its last, along each axis.
    [[nodiscard]] Index3 begin(std::int64_t tile) const {
        return {tile % tiles_[0] * side_[0], tile / tiles_[0] % tiles_[1] * side_[1], tile / (tiles_[0] * tiles_[1]) * side_[2]};
    }
    [[nodiscard]] Index3 end(std::int64_t tile) const { return min(begin(tile) + side_, extent_.size); }

private:
    Extent extent_;
    Index3 side_, tiles_{};
};

}  // namespace isoatlas
