// GridView: a grid of samples as later stages access it, by the slices that are in memory.
//
// The slab passes touch only the slices [z_begin - 1, z_end] of their slab, so the same code serves a volume in memory and one that is
// streamed. z is the last axis of a 3D grid; a 2D grid is one slice.
#pragma once

#include <cstdint>

#include "isoatlas/volume.h"

namespace isoatlas {

/// Samples of T on an extent. slice(z) is the only access to samples; 0 <= z < size[2].
template <class T>
struct GridView {
    const T* samples;
    Extent extent;
    Index3 origin{};  ///< voxel of the first sample, where the grid is a window of a larger one

    [[nodiscard]] const T* slice(std::int64_t z) const { return samples + z * extent.slice(); }
    [[nodiscard]] const T* row(std::int64_t y, std::int64_t z) const { return slice(z) + y * extent.size[0]; }
    [[nodiscard]] bool is_3d() const { return extent.rank == 3; }
};

/// The slices [z_begin, z_end) of a grid: the unit of work.
struct Slab {
    std::int64_t z_begin, z_end;
};

/// Slab i of a grid cut into slabs of the given height.
constexpr Slab slab_at(std::int64_t i, std::int64_t height, std::int64_t slices) {
    const std::int64_t begin = i * height;
    return {begin, begin + height < slices ? begin + height : slices};
}

}  // namespace isoatlas
