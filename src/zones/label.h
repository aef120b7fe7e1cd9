// The zone of every voxel, slab by slab.
// In the literature: segmentation by the arcs of a fully augmented merge tree (Carr, Snoeyink, Axen 2003).
#pragma once

#include <cstdint>
#include <span>

#include "tree/heavy_paths.h"

namespace isoatlas {

/// Replaces the basin entries of `samples.size()` consecutive voxels by their zones and counts them.
/// Zones and counts by their numbers: a zone takes the place of a basin. Of a join tree, zones are elements. counts (per event, shared by
/// all slabs) is added to atomically. Cost: O(1) expected a voxel.
template <class T, class Number>
void label_zones(std::span<const T> samples, const HeavyPathDecomposition<Number, ComparisonValue<T>>& paths,
                 std::span<Number> basin_to_zone, std::span<Number> counts);

}  // namespace isoatlas
