// Basins: for every voxel one maximum that an ascending path reaches, and one minimum (or the outside) that a descending path reaches.
//
// Any ascending path will do, not only the steepest: all neighbours above a voxel lie in its object just above it, so the tree built on
// the maxima does not depend on the choice (docs/theory/3-trees.md#only-critical-elements; docs/decisions/0003). Paths prefer neighbours
// that come before in raster order: their basin is known already, so one forward and one backward scan resolve almost everything.
//
// Basin numbers: maxima are numbered in raster order from 0; minima from 1, the outside of the grid (EXT) is 0.
//
// In the literature: peaks reached by monotone paths (Carr et al., Parallel peak pruning, 2016); basins of a watershed transform, there
// mostly along steepest paths.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/check.h"
#include "field/grid.h"

namespace isoatlas {

enum class Direction : std::uint8_t { up, down };

/// Resolves the basins of a whole grid in steps that touch one slab each; slabs run in parallel, the result is the same for any cut.
///   1. forward(slab): needs the links of the slab only; afterwards every basin entry is a number or points to a voxel.
///   2. exits(): pointers that leave their slab, on the first and last slice of every slab.
///   3. finish(slab).
/// Number: 32 bits when the grid has less than 2^31 voxels, else 64. Memory: one number per voxel, owned by the caller.
template <class Number>
class Basins {
public:
    Basins(const Extent& extent, std::int64_t slab_height, Direction direction, std::span<const std::uint8_t> links,
           std::span<Number> basin);

    /// first_number: how many extrema of this direction lie in the slabs before.
    void forward(std::int64_t slab, std::int64_t first_number);
    void exits();
    void finish(std::int64_t slab);

    /// The basin number in a finished entry.
    [[nodiscard]] static constexpr Number number(Number entry) { return entry & ~kNumber; }

private:
    static constexpr Number kNumber = Number{1} << (8 * sizeof(Number) - 1);  ///< set: a basin number; clear: a voxel to follow

    [[nodiscard]] Slab range(std::int64_t slab) const { return slab_at(slab, height_, extent_.size[2]); }
    void point(Slab slab, Number& next);
    void compress(std::int64_t voxel, std::int64_t first, std::int64_t last, std::vector<std::int64_t>& path);

    Extent extent_;
    std::int64_t height_;
    Direction direction_;
    std::span<const std::uint8_t> links_;
    std::span<Number> basin_;
};

}  // namespace isoatlas
