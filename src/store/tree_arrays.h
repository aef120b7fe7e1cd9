// An analysis as arrays of a store, and back.
//
//   elements/value, code     per critical element, descending: value; ElementCode bits (field/order.h)
//   elements/level           highest element of its level
//   contours/other, half_chi, degree      the contour tree (tree/contour_tree.h): one node more, the outside
//   events/of_element        per element: its event
//   events/top, parent, kind, lows_out, contours, delta_chi, chi, voxels     the criticality tree (tree/criticality_tree.h)
//
// Ids are uint32, or uint64 where the engine needs them. Zones of voxels are not stored.
#pragma once

#include <vector>

#include "isoatlas/analysis.h"
#include "store/container.h"
#include "store/pack.h"

namespace isoatlas::store {

/// The analysis must live until the arrays are packed.
[[nodiscard]] std::vector<PackedArray> tree_arrays(const Analysis& analysis);

/// The analysis of a store, without zones of voxels. Throws Error{input} when arrays contradict each other. Cost: reads all of them.
[[nodiscard]] Analysis analysis_of(const Container& store);

}  // namespace isoatlas::store
