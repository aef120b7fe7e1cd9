// An analysis as arrays of a store, and back.
//
//   elements/value, place, form the critical elements (atlas/element_arrays.h)
//   elements/towards_outside    the contour tree (tree/contour_tree.h): per element the other end of its arc; one node more, the outside
//   elements/voxels             per critical element: voxels that belong to it (zones/count_voxels.h); those of an event are its zone
//
// Levels, genera, events and their measures follow from the first four and are computed on reading. Ids are uint32, or uint64 where
// the engine needs them. Zones of voxels are not stored.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/contour_arcs.h"

namespace isoatlas {

class Container;
struct PackedArray;

/// The arcs, the voxels must live until they are packed.
[[nodiscard]] std::vector<PackedArray> tree_arrays(const ContourArcs& arcs, const VolumeInfo& volume, int threads);
[[nodiscard]] PackedArray voxel_array(const ElementVoxels& voxels);

/// All arrays of another store, which must live until they are packed.
[[nodiscard]] std::vector<PackedArray> copied_arrays(const Container& store);

/// As compute_arcs(). samples: of the volume, x fastest; null: those of the store, which are read for stores with many elements. Throws
/// Error: input (inconsistent arrays), cancelled. Cost: reads them.
[[nodiscard]] ContourArcs arcs_of(const Container& store, const std::byte* samples, const Context& context);
/// The analysis of a store, without zones of voxels. Throws Error: input (inconsistent arrays), cancelled. Cost: reads all of
/// them, O(n alpha).
[[nodiscard]] Analysis analysis_of(const Container& store, const Context& context);
/// The same with zones. volume: all samples of the store. Cost: and add_zones() (analysis/contour_arcs.h).
[[nodiscard]] Analysis zoned_analysis_of(const Container& store, const VolumeView& volume, const Context& context);

}  // namespace isoatlas
