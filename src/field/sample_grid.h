// Samples that lie in memory row by row, as in a volume, or brick by brick, as in a store: where a sample lies is a sum of what each of its
// coordinates adds, so the same kernels read both.
#pragma once

#include <cstddef>

#include "field/volume_view.h"

namespace isoatlas {

/// What a coordinate adds: a step for each voxel, and a jump where a brick ends. Bricks are 2^shift long.
struct AxisLayout {
    std::int64_t step = 0, jump = 0;
    int shift = 0;
    [[nodiscard]] std::int64_t operator()(std::int64_t i) const { return step * i + jump * (i >> shift); }
};

struct SampleLayout {
    std::array<AxisLayout, 3> axis;

    [[nodiscard]] static SampleLayout of_volume(const Extent& extent) {
        return {{{{.step = 1}, {.step = extent.size[0]}, {.step = extent.slice()}}}};
    }
    [[nodiscard]] std::int64_t at(std::int64_t x, std::int64_t y, std::int64_t z) const { return axis[0](x) + axis[1](y) + axis[2](z); }
};

/// The samples of a row: row[x].
template <class T>
struct SampleRow {
    const T* samples;
    AxisLayout x;
    [[nodiscard]] T operator[](std::int64_t i) const { return samples[x(i)]; }
};

/// Samples of T on an extent.
template <class T>
struct SampleGrid {
    const T* samples;
    Extent extent;
    SampleLayout layout;
    Index3 origin{};  ///< voxel of the first sample, where the grid is a window of a larger one

    [[nodiscard]] T at(std::int64_t x, std::int64_t y, std::int64_t z) const { return samples[layout.at(x, y, z)]; }
    [[nodiscard]] T at(const Index3& voxel) const { return at(voxel[0], voxel[1], voxel[2]); }
    /// Sample at corner k of the cell whose corner 0 is a voxel, or adjacent to one.
    [[nodiscard]] T corner(const Index3& cell, int k) const { return at(cell[0] + (k & 1), cell[1] + (k >> 1 & 1), cell[2] + (k >> 2)); }
    [[nodiscard]] SampleRow<T> row(std::int64_t y, std::int64_t z) const {
        return {samples + layout.axis[1](y) + layout.axis[2](z), layout.axis[0]};
    }
    [[nodiscard]] bool is_3d() const { return extent.rank == 3; }
};

/// A volume whose samples lie anywhere, in any layout.
struct SampleView {
    const VolumeInfo* info;
    const std::byte* bytes;
    SampleLayout layout;

    SampleView(const VolumeInfo& of, const std::byte* samples, const SampleLayout& how) : info(&of), bytes(samples), layout(how) {}
    SampleView(const VolumeView& volume)  // NOLINT(google-explicit-constructor): it is one
        : SampleView(*volume.info, volume.bytes, SampleLayout::of_volume(volume.info->extent)) {}
    SampleView(const Volume& volume) : SampleView(VolumeView(volume)) {}  // NOLINT(google-explicit-constructor): it is one
};

/// Calls function(SampleGrid<T>) with the samples.
template <class Function>
decltype(auto) visit_grid(const SampleView& view, Function&& function) {
    return visit_type(view.info->type, [&]<class T>(T) -> decltype(auto) {
        return function(SampleGrid<T>{reinterpret_cast<const T*>(view.bytes), view.info->extent, view.layout});
    });
}

}  // namespace isoatlas
