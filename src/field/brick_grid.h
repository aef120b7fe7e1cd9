// BrickGrid: partition of a volume into bricks of 16 x 8 x 8 samples (docs/decisions/0014); the last ones of an axis are smaller.
#pragma once

#include <cstdint>
#include <vector>

#include "base/id_array.h"
#include "isoatlas/volume.h"

namespace isoatlas {

inline constexpr Index3 kBrickSize{16, 8, 8};  ///< samples along x, y, z
inline constexpr std::int64_t kBrickRow = kBrickSize[0];
inline constexpr std::int64_t kBrickSamples = kBrickSize.product();

/// Samples [begin, end) of each axis.
struct Box {
    Index3 begin, end;
    [[nodiscard]] std::int64_t size(int axis) const { return end[axis] - begin[axis]; }
    [[nodiscard]] Index3 size() const { return end - begin; }
    [[nodiscard]] std::int64_t count() const { return size().product(); }
};

using BrickId = StrongId<struct BrickTag, std::int64_t>;  ///< of a brick of a grid: x + size[0] * (y + size[1] * z)
using BrickFlags = IdArray<BrickId, std::uint8_t>;        ///< 0 or 1 for every brick

struct BrickGrid {
    Extent extent;
    Index3 size;  ///< bricks of each axis

    explicit BrickGrid(const Extent& volume) : extent(volume) {
        for (int axis = 0; axis < 3; ++axis) size[axis] = (volume.size[axis] + kBrickSize[axis] - 1) / kBrickSize[axis];
    }
    [[nodiscard]] std::int64_t count() const { return size.product(); }
    [[nodiscard]] IdRange<BrickId> bricks() const { return bricks_between(0, count()); }
    [[nodiscard]] IdRange<BrickId> bricks_of_layer(std::int64_t z) const { return bricks_between(z * layer(), (z + 1) * layer()); }
    /// row: y + size[1] * z.
    [[nodiscard]] IdRange<BrickId> bricks_of_row(std::int64_t row) const { return bricks_between(row * size[0], (row + 1) * size[0]); }
    [[nodiscard]] BrickId brick(const Index3& place) const { return BrickId(place[0] + size[0] * (place[1] + size[1] * place[2])); }
    /// The place of the brick that a voxel lies in.
    [[nodiscard]] static Index3 place_of(const Index3& voxel) {
        return {voxel[0] / kBrickSize[0], voxel[1] / kBrickSize[1], voxel[2] / kBrickSize[2]};
    }
    [[nodiscard]] Index3 place(BrickId brick) const {
        const std::int64_t b = brick.number();
        return {b % size[0], b / size[0] % size[1], b / size[0] / size[1]};
    }
    /// Samples along an axis of the bricks at a place along it.
    [[nodiscard]] std::int64_t length(int axis, std::int64_t place) const {
        const std::int64_t left = extent.size[axis] - place * kBrickSize[axis];
        return left < kBrickSize[axis] ? left : kBrickSize[axis];
    }
    [[nodiscard]] Box box(BrickId brick) const;
    /// All bricks in the order in which they lie in a store: along a curve that keeps neighbours together (Morton order).
    [[nodiscard]] std::vector<BrickId> file_order() const;

private:
    [[nodiscard]] std::int64_t layer() const { return size[0] * size[1]; }
    [[nodiscard]] static IdRange<BrickId> bricks_between(std::int64_t first, std::int64_t end) { return {BrickId(first), BrickId(end)}; }
};

}  // namespace isoatlas
