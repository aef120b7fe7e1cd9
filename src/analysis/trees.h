// The trees of an analysis: from critical elements, or restored from the contour tree alone.
#pragma once

#include "analysis/analysis_data.h"
#include "critical/critical_set.h"

namespace isoatlas {

/// Fills in value, code and the contour tree. Returns the join tree. Cost: O(n alpha).
template <class Number>
MergeTree<Number> make_arcs(CriticalSet<Number> set, AnalysisArrays<Number>& arrays, int threads);

/// What the measures of events are made of, beside the trees; both per element.
template <class Number>
struct ElementMeasures {
    ByElement<Number, std::int8_t> delta_chi;
    ByElement<Number, LevelKind> kind;
};

/// Fills in everything but the zones and the measures of the events. Throws Error{cancelled}. Cost: O(n alpha).
template <class Number>
[[nodiscard]] ElementMeasures<Number> make_trees(CriticalSet<Number> set, AnalysisArrays<Number>& arrays, const Context& context);

/// Fills in the measures of the events: 17 bytes each, which the zones, made before, need not have beside them. Cost: O(n).
template <class Number>
void make_measures(const ElementMeasures<Number>& elements, AnalysisArrays<Number>& arrays, int threads);

/// The trees and measures from value, code and contours.other, all else follows from them. Returns false when these are not the contour
/// tree of a box: a damaged store. Throws Error{cancelled}. Cost: O(n alpha).
template <class Number>
[[nodiscard]] bool restore_trees(AnalysisArrays<Number>& arrays, int rank, const Context& context);

/// Per element: change of the Euler characteristic.
template <class Number>
[[nodiscard]] ByElement<Number, std::int8_t> delta_chis(const ByElement<Number, std::uint64_t>& code, int rank);

/// Voxels of the zones of events, from those of the elements (zones/count_voxels.h).
template <class Number>
void add_up_voxels(ByElementView<Number, Number> element_voxels, AnalysisArrays<Number>& arrays);

}  // namespace isoatlas
