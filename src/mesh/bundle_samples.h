// The samples of a bundle of rows and those around it, whatever the layout of the volume, and what turns their differences into slopes.
//
// A bundle is 8 x 32 rows along x, along y as wide as a brick. Its local coordinates are x of the volume, and y and z from
// its first row on. One sample before it and two behind it are known along each axis: the far end of an edge and its neighbour; beyond the
// ends of the grid the last sample is repeated.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "base/prefetch.h"
#include "field/sample_grid.h"
#include "mesh/physical_map.h"
#include "store/brick_grid.h"

namespace isoatlas {

inline constexpr std::array<std::int64_t, 3> kBundleSize{0, store::kBrickSize[1], 32};  ///< rows along y and z

/// Real: what differences and slopes are computed in.
template <class T, class Real>
class BundleSamples {
public:
    explicit BundleSamples(const SampleGrid<T>& grid, const PhysicalMap& map) : grid_(grid), map_(map) {
        add_axis(0, 0, grid.extent.size[0]);
    }

    /// y, z: the first row.
    void move_to(std::int64_t y, std::int64_t z) {
        add_axis(1, y, kBundleSize[1]);
        add_axis(2, z, kBundleSize[2]);
    }

    /// A sample, and how much its neighbours along each axis differ.
    struct Around {
        T sample;
        std::array<Real, 3> difference;
    };
    [[nodiscard]] Around around(std::int32_t x, std::int32_t y, std::int32_t z) const {
        const std::int64_t *const at_x = offset(0, x), *const at_y = offset(1, y), *const at_z = offset(2, z);
        const T* const samples = grid_.samples;
        return {samples[*at_x + *at_y + *at_z],
                {difference(samples + *at_y + *at_z, at_x), difference(samples + *at_x + *at_z, at_y),
                 difference(samples + *at_x + *at_y, at_z)}};
    }

    /// Asks for samples that later slices look at: some slices behind row (y, z), where bits say, from sample x on. Also those of rows
    /// beside the bundle.
    void prefetch_slice(std::int64_t x, std::uint64_t bits, std::int32_t y, std::int32_t z) const {
        const std::int64_t at_z =
            *offset(2, static_cast<std::int32_t>(std::min<std::int64_t>(z + kSlicesAhead, kBundleSize[2] + kBehind - 1)));
        for (int i = 0; i < 64; i += kStretch) {
            if ((bits >> i & 0xffff) == 0) continue;
            const std::int64_t at_x = std::clamp<std::int64_t>(x + i + kStretch / 2, 0, grid_.extent.size[0] - 1);
            const T* const column = grid_.samples + *offset(0, static_cast<std::int32_t>(at_x)) + at_z;
            prefetch(column + *offset(1, y));
            if (y == 0) prefetch(column + *offset(1, -1));
            if (y + kBehind >= kBundleSize[1]) prefetch(column + *offset(1, y + static_cast<std::int32_t>(kBehind)));
        }
    }

    /// 1 / (distance of the neighbours) of a sample along an axis.
    [[nodiscard]] Real scale(std::size_t axis, std::int32_t at) const { return axes_[axis].scale[static_cast<std::size_t>(at)]; }
    /// Are they the same for all samples of the bundle that have two neighbours along x?
    [[nodiscard]] bool has_same_scales() const { return axes_[0].is_even && axes_[1].is_even && axes_[2].is_even; }
    [[nodiscard]] std::array<Real, 3> same_scales() const {
        return {axes_[0].scale[axes_[0].scale.size() > 1 ? 1 : 0], axes_[1].scale[0], axes_[2].scale[0]};
    }

private:
    static constexpr std::int64_t kBefore = 1, kBehind = 2;
    static constexpr std::int32_t kSlicesAhead = 3;  ///< one more than is looked at
    static constexpr int kStretch = 16;

    /// By local coordinates, offsets from kBefore before the first one on.
    struct Axis {
        std::vector<std::int64_t> offset;  ///< what a coordinate adds to where a sample lies
        std::vector<Real> scale;           ///< of the samples of the bundle and the one behind it
        bool is_even = true;               ///< all are the same; along x but for those at the ends of the grid
    };

    void add_axis(std::size_t number, std::int64_t begin, std::int64_t size) {
        Axis& axis = axes_[number];
        axis.offset.resize(static_cast<std::size_t>(size + kBefore + kBehind));
        axis.scale.resize(static_cast<std::size_t>(size + 1));
        const std::int64_t last = grid_.extent.size[number] - 1;
        for (std::int64_t i = -kBefore; i < size + kBehind; ++i)
            axis.offset[static_cast<std::size_t>(i + kBefore)] = grid_.layout.axis[number](std::clamp<std::int64_t>(begin + i, 0, last));
        const double* scales = map_.inverse_distance(static_cast<int>(number)) + grid_.origin[number];
        for (std::int64_t i = 0; i <= size; ++i)
            axis.scale[static_cast<std::size_t>(i)] = static_cast<Real>(scales[std::min(begin + i, last)]);
        const auto first = axis.scale.begin() + (number == 0 && size > 1 ? 1 : 0),
                   end = axis.scale.end() - (number == 0 && size > 2 ? 2 : 0);
        axis.is_even = std::all_of(first, end, [&](Real scale) { return scale == *first; });
    }
    [[nodiscard]] const std::int64_t* offset(std::size_t axis, std::int32_t local) const {
        return axes_[axis].offset.data() + kBefore + local;
    }
    [[nodiscard]] static Real difference(const T* origin, const std::int64_t* at) {
        return static_cast<Real>(origin[at[1]]) - static_cast<Real>(origin[at[-1]]);
    }

    SampleGrid<T> grid_;
    const PhysicalMap& map_;
    std::array<Axis, 3> axes_;
};

}  // namespace isoatlas
