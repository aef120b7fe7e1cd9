// Counts over the isovalue, reduced to the resolution of a plot.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "catalogue/page_axis.h"
#include "isoatlas/analysis.h"
#include "isoatlas/spectrum.h"

namespace isoatlas {

/// For isovalues in (low, high] the counts lie between min and max, both included.
struct CountColumn {
    double low, high;  ///< stored values
    LevelCounts min, max, min_significant, max_significant;
};

/// Columns by ascending isovalue that cover the part of `intervals` (as in Spectrum) that lies in (low, scale.high]. When there are at most
/// that many intervals, they are the columns and min equals max; else the columns are equally wide on the axis: with a column a pixel the
/// plot equals that of all intervals (Jugel et al., M4, 2014). Cost: O(intervals + columns).
[[nodiscard]] std::vector<CountColumn> count_columns(std::span<const SpectrumInterval> intervals, double low, const AxisScale& scale,
                                                     std::int64_t columns);

/// Counts of the object of a branch for every isovalue: the intervals (merges, appears] downwards from the event at which the branch
/// begins, counts of one object in `all`. Cost: O(events of the branch).
[[nodiscard]] std::vector<SpectrumInterval> branch_intervals(const Analysis& analysis, EventId branch_top, double merges);

}  // namespace isoatlas
