// BrickGrid: partition of a volume into bricks of 16 x 8 x 8 samples (docs/decisions/0014); the last ones of an axis are smaller.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

inline constexpr std::array<std::int64_t, 3> kBrickSize{16, 8, 8};  ///< samples along x, y, z
inline constexpr std::int64_t kBrickRow = kBrickSize[0];
inline constexpr std::int64_t kBrickSamples = kBrickSize[0] * kBrickSize[1] * kBrickSize[2];

/// Samples [begin, end) of each axis.
struct Box {
    std::array<std::int64_t, 3> begin, end;
    [[nodiscard]] std::int64_t size(int axis) const { return end[axis] - begin[axis]; }
    [[nodiscard]] std::array<std::int64_t, 3> size() const { return {size(0), size(1), size(2)}; }
    [[nodiscard]] std::int64_t count() const { return size(0) * size(1) * size(2); }
};

struct BrickGrid {
    Extent extent;
    std::array<std::int64_t, 3> size;  ///< bricks of each axis; brick = x + size[0] * (y + size[1] * z)

    explicit BrickGrid(const Extent& volume) : extent(volume) {
        for (int axis = 0; axis < 3; ++axis) size[axis] = (volume.size[axis] + kBrickSize[axis] - 1) / kBrickSize[axis];
    }
    [[nodiscard]] std::int64_t count() const { return size[0] * size[1] * size[2]; }
    [[nodiscard]] std::int64_t brick(const std::array<std::int64_t, 3>& place) const {
        return place[0] + size[0] * (place[1] + size[1] * place[2]);
    }
    /// The place of the brick that a voxel lies in.
    [[nodiscard]] static std::array<std::int64_t, 3> place_of(const std::array<std::int64_t, 3>& voxel) {
        return {voxel[0] / kBrickSize[0], voxel[1] / kBrickSize[1], voxel[2] / kBrickSize[2]};
    }
    [[nodiscard]] std::array<std::int64_t, 3> place(std::int64_t brick) const {
        return {brick % size[0], brick / size[0] % size[1], brick / size[0] / size[1]};
    }
    /// Samples along an axis of the bricks at a place along it.
    [[nodiscard]] std::int64_t length(int axis, std::int64_t place) const {
        const std::int64_t left = extent.size[axis] - place * kBrickSize[axis];
        return left < kBrickSize[axis] ? left : kBrickSize[axis];
    }
    [[nodiscard]] Box box(std::int64_t brick) const;
    /// All bricks in the order in which they lie in a store: along a curve that keeps neighbours together (Morton order).
    [[nodiscard]] std::vector<std::int64_t> file_order() const;
};

}  // namespace isoatlas
