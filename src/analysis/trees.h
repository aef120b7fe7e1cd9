// The trees of an analysis: from critical elements, or restored from the contour tree alone.
#pragma once

#include "analysis/analysis_data.h"
#include "critical/critical_set.h"

namespace isoatlas {

/// Fills in value, code and the contour tree. Returns the join tree. Cost: O(n alpha).
template <class Id>
BigVector<Id> make_arcs(CriticalSet<Id> set, AnalysisArrays<Id>& arrays, int threads);

/// Fills in everything but the zones. Throws Error{cancelled}. Cost: O(n alpha).
template <class Id>
void make_trees(CriticalSet<Id> set, AnalysisArrays<Id>& arrays, const Context& context);

/// The same from value, code and contours.other, all else follows from them. Returns false when these are not the contour tree of a box: a
/// damaged store. Throws Error{cancelled}. Cost: O(n alpha).
template <class Id>
[[nodiscard]] bool restore_trees(AnalysisArrays<Id>& arrays, int rank, const Context& context);

/// Per element: change of the Euler characteristic.
[[nodiscard]] BigVector<std::int8_t> delta_chis(std::span<const std::uint64_t> code, int rank);

/// Voxels of the zones of events, from those of the elements (zones/count_voxels.h).
template <class Id>
void add_up_voxels(std::span<const Id> element_voxels, AnalysisArrays<Id>& arrays);

}  // namespace isoatlas
