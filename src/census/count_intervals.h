// Numbers of objects, contours, tunnels and cavities at every isovalue, from the criticality tree alone.
// In the literature: Betti curves; part of a contour spectrum (Bajaj, Pascucci, Schikore, The contour spectrum, 1997).
#pragma once

#include <vector>

namespace isoatlas {

class Analysis;
struct ObjectEntry;
struct ObjectTable;
struct SpectrumInterval;
template <class Id>
struct AnalysisArrays;

/// Per event: does its object belong to a branch of the table? Every branch counts once, regardless of its number of entries. Throws
/// Error{input} when the table is not of these trees. Cost: O(events of these branches).
template <class Id>
[[nodiscard]] std::vector<bool> events_of_entries(const AnalysisArrays<Id>& arrays, const std::vector<ObjectEntry>& entries);

/// Intervals between neighbouring values of events, descending. significant: per event. Cost: O(events).
template <class Id>
[[nodiscard]] std::vector<SpectrumInterval> count_intervals(const AnalysisArrays<Id>& arrays, int rank,
                                                            const std::vector<bool>& significant);

/// The same; significant are the objects of a table of these trees.
[[nodiscard]] std::vector<SpectrumInterval> count_intervals(const Analysis& analysis, const ObjectTable& table);

}  // namespace isoatlas
