// Gather of samples for central-difference normals, for a tile of 8 x 32 rows, from any layout of the volume.
//
// A bundle is that tile: rows along x, 8 of them along y (as wide as a brick) times 32 along z. Its local coordinates are x of the volume,
// and y and z from its first row on. One sample before it and two behind it are known along each axis: the far end of an edge and its
// neighbour; beyond the ends of the grid the last sample is repeated.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "base/prefetch.h"
#include "field/brick_grid.h"
#include "field/sample_grid.h"
#include "mesh/hit_batch.h"
#include "mesh/layout.h"
#include "mesh/physical_map.h"

namespace isoatlas {

inline constexpr Index3 kBundleSize{0, kBrickSize[1], 32};  ///< rows along y and z

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

    /// Samples at the ends of the edges of hits along an axis, and how much their neighbours along each axis differ: into slope at the
    /// first end, into change at the other one.
    void gather(const HitBatch& batch, std::size_t axis, bool normals, HitValues<Real>& values) const {
        if (!normals)
            gather_ends(batch, axis, values);
        else if (axis == 0)
            gather_along(batch, values);
        else if (axis == 1)
            gather_across<1>(batch, values);
        else
            gather_across<2>(batch, values);
    }

    /// Prefetches samples that are read for hits of row (y, z), near the first and the last of some samples of it, and those that later
    /// slices will read: some slices behind the row, and where it is the last one, next to the bundle.
    void prefetch_around(std::int64_t first, std::int64_t last, std::int32_t y, std::int32_t z) const {
        const T* const from = grid_.samples + *offset(0, static_cast<std::int32_t>(first));
        const T* const to = grid_.samples + *offset(0, static_cast<std::int32_t>(last));
        const auto prefetch_row = [&](std::int64_t at_y, std::int64_t at_z) {
            const std::int64_t row = *offset(1, static_cast<std::int32_t>(at_y)) + *offset(2, static_cast<std::int32_t>(at_z));
            prefetch(from + row), prefetch(to + row);
        };
        const std::int64_t ahead = std::min<std::int64_t>(z + kSlicesAhead, kBundleSize[2] + kBehind - 1);
        prefetch_row(y, ahead);
        if (y == 0) prefetch_row(-1, ahead);
        if (y + kBehind >= kBundleSize[1]) prefetch_row(y + kBehind, ahead);
        prefetch_row(y, z + 1), prefetch_row(y, z + 2);  // an inclined surface reaches cache lines that are not prefetched yet
        prefetch_row(y - 1, z), prefetch_row(y + 1, z), prefetch_row(y + 2, z);
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
    [[nodiscard]] static Real difference(T of, T from) { return static_cast<Real>(of) - static_cast<Real>(from); }

    /// A row by what its coordinates add, as where its samples would lie if x added nothing.
    [[nodiscard]] const T* row(std::int64_t y_adds, std::int64_t z_adds) const { return grid_.samples + y_adds + z_adds; }

    void gather_ends(const HitBatch& batch, std::size_t axis, HitValues<Real>& values) const {
        for (std::size_t i = 0; i < batch.count; ++i) {
            const std::array at{offset(0, batch.from[0][i]), offset(1, batch.from[1][i]), offset(2, batch.from[2][i])};
            const T* const own = grid_.samples + *at[0] + *at[1] + *at[2];
            values.a[i] = static_cast<Real>(*own), values.b[i] = static_cast<Real>(own[at[axis][1] - at[axis][0]]);
        }
    }

    /// Edges along x.
    void gather_along(const HitBatch& batch, HitValues<Real>& values) const {
        for (std::size_t i = 0; i < batch.count; ++i) {
            const std::int64_t* const x = offset(0, batch.from[0][i]);
            const std::int64_t* const y = offset(1, batch.from[1][i]);
            const std::int64_t* const z = offset(2, batch.from[2][i]);
            const T* const own = row(y[0], z[0]);
            const std::array<const T*, 2> beside_y{row(y[-1], z[0]), row(y[1], z[0])}, beside_z{row(y[0], z[-1]), row(y[0], z[1])};
            const std::int64_t here = x[0], next = x[1];
            const T a = own[here], b = own[next];
            values.a[i] = static_cast<Real>(a), values.b[i] = static_cast<Real>(b);
            values.slope[0][i] = difference(b, own[x[-1]]), values.change[0][i] = difference(own[x[2]], a);
            values.slope[1][i] = difference(beside_y[1][here], beside_y[0][here]);
            values.change[1][i] = difference(beside_y[1][next], beside_y[0][next]);
            values.slope[2][i] = difference(beside_z[1][here], beside_z[0][here]);
            values.change[2][i] = difference(beside_z[1][next], beside_z[0][next]);
        }
    }

    /// Edges to the next row along an axis.
    template <std::size_t axis>
    void gather_across(const HitBatch& batch, HitValues<Real>& values) const {
        constexpr std::size_t other = 3 - axis;
        for (std::size_t i = 0; i < batch.count; ++i) {
            const std::int64_t* const x = offset(0, batch.from[0][i]);
            const std::int64_t* const y = offset(1, batch.from[1][i]);
            const std::int64_t* const z = offset(2, batch.from[2][i]);
            const std::int64_t* const along = axis == 1 ? y : z;
            const std::int64_t* const across = axis == 1 ? z : y;
            const T* const line = grid_.samples + across[0];  // the rows along the axis
            const std::array<const T*, 2> beside{grid_.samples + across[-1], grid_.samples + across[1]};
            const std::int64_t here = along[0] + x[0], next = along[1] + x[0];
            const T a = line[here], b = line[next];
            values.a[i] = static_cast<Real>(a), values.b[i] = static_cast<Real>(b);
            values.slope[0][i] = difference(line[along[0] + x[1]], line[along[0] + x[-1]]);
            values.change[0][i] = difference(line[along[1] + x[1]], line[along[1] + x[-1]]);
            values.slope[axis][i] = difference(b, line[along[-1] + x[0]]), values.change[axis][i] = difference(line[along[2] + x[0]], a);
            values.slope[other][i] = difference(beside[1][here], beside[0][here]);
            values.change[other][i] = difference(beside[1][next], beside[0][next]);
        }
    }

    SampleGrid<T> grid_;
    const PhysicalMap& map_;
    std::array<Axis, 3> axes_;
};

}  // namespace isoatlas
