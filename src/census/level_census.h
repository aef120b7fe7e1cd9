// Numbers of samples, hits and active cells for all isovalues, counted while a store is built.
//
// A cell is active at tau when its lowest corner is below tau and its highest is not; so is an edge of the grid hit. So four numbers per
// value are sufficient: cells and edges whose highest end is at least that value, and whose lowest is. For integers of few values these are
// all values and the counts are exact; else the two values around an isovalue give bounds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "field/volume_view.h"
#include "isoatlas/bounds.h"
#include "isoatlas/context.h"

namespace isoatlas {

struct LevelCensus {
    std::vector<double> value;                                              ///< ascending, from the lowest sample to the highest
    std::vector<std::uint64_t> samples;                                     ///< number of samples >= this value
    std::vector<std::uint64_t> cells_high, cells_low, hits_high, hits_low;  ///< whose highest, lowest end is at least this value

    struct Counts {
        Bounds samples, hits, cells;
    };
    /// At an isovalue; padding counts as in Cut. whole: samples are whole numbers.
    [[nodiscard]] Counts at(double tau, bool whole) const;
};

/// The counted values for finite samples from low to high: all, or a limited number.
[[nodiscard]] std::vector<double> census_values(double low, double high, bool whole, std::int64_t voxels);

/// Counts by bin, of a part of a volume; parts are additive. Bin 0 is the padding, bin i + 1 is [value[i], value[i + 1]).
struct CensusPart {
    using Counts = std::vector<std::uint64_t>;
    Counts samples, cells_high, cells_low, hits_high, hits_low;

    explicit CensusPart(std::size_t values);
    void add(const CensusPart& other);
    [[nodiscard]] LevelCensus finish(std::vector<double> values) const;
};

/// Layers of cells z, first <= z < last: between the slices z and z + 1, from -1 in 3D; the slices themselves, from 0, in 2D.
/// slab: the slices from `begin` on, at least those of these layers that exist. Cost: 1 pass, 4 bytes a voxel of a slice.
template <class T>
[[nodiscard]] CensusPart count_layers(const T* slab, std::int64_t begin, const Extent& extent, std::span<const double> values,
                                      std::int64_t first, std::int64_t last);

/// Parallel version; the result does not depend on threads. Samples are finite. Cost: two passes over the samples.
[[nodiscard]] LevelCensus take_census(const VolumeView& volume, const Context& context);

}  // namespace isoatlas
