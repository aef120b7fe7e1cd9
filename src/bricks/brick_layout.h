// Memory layout of bricks in slots of fixed size: brick by brick, x fastest within a brick. Bricks at the far ends of a volume leave the
// ends of their rows and slices unused.
#pragma once

#include <algorithm>
#include <bit>

#include "field/brick_grid.h"
#include "field/sample_grid.h"

namespace isoatlas {

class BrickLayout {
public:
    explicit BrickLayout(const BrickGrid& grid) : grid_(grid), slices_(std::min(kBrickSize[2], grid.extent.size[2])) {}

    /// Size of the slot of a brick.
    [[nodiscard]] std::int64_t samples_of_brick() const { return kSlice * slices_; }
    [[nodiscard]] std::int64_t first_sample(BrickId brick) const { return brick.number() * samples_of_brick(); }
    /// First sample of a row of a brick; y, z: in the brick.
    [[nodiscard]] std::int64_t row(BrickId brick, std::int64_t y, std::int64_t z) const {
        return first_sample(brick) + y * kBrickRow + z * kSlice;
    }
    /// The same positions by voxel coordinates.
    [[nodiscard]] SampleLayout by_voxel() const {
        const std::int64_t along_x = samples_of_brick(), along_y = along_x * grid_.size[0], along_z = along_y * grid_.size[1];
        return {{{axis(0, 1, along_x), axis(1, kBrickRow, along_y), axis(2, kSlice, along_z)}}};
    }

private:
    static constexpr std::int64_t kSlice = kBrickRow * kBrickSize[1];

    static AxisLayout axis(std::size_t number, std::int64_t step, std::int64_t to_next_brick) {
        const std::int64_t side = kBrickSize[number];
        return {.step = step, .jump = to_next_brick - step * side, .shift = std::countr_zero(static_cast<std::uint64_t>(side))};
    }

    const BrickGrid& grid_;
    std::int64_t slices_;
};

}  // namespace isoatlas
