#include "formats/tree/spectrum_columns.h"

#include <algorithm>

namespace isoatlas {

namespace {

void widen(CountRange& range, const LevelCounts& counts) {
    for (const auto count : {&LevelCounts::objects, &LevelCounts::contours, &LevelCounts::tunnels, &LevelCounts::cavities}) {
        range.min.*count = std::min(range.min.*count, counts.*count);
        range.max.*count = std::max(range.max.*count, counts.*count);
    }
}

/// The number of the column of interval i.
std::int64_t column_of(const std::vector<SpectrumInterval>& intervals, std::size_t i, std::int64_t max_columns) {
    const double top = intervals.front().high / 2, range = top - intervals.back().high / 2;  // halves: differences do not overflow
    const double by_value = range > 0 ? (top - intervals[i].high / 2) / range : 0;
    const double by_number = static_cast<double>(i) / static_cast<double>(intervals.size());
    return std::min(max_columns - 1, static_cast<std::int64_t>((by_value + by_number) / 2 * static_cast<double>(max_columns)));
}

}  // namespace

std::vector<SpectrumColumn> spectrum_columns(const Spectrum& spectrum, std::int64_t max_columns) {
    const std::vector<SpectrumInterval>& intervals = spectrum.intervals;
    const bool merges = max_columns > 0 && static_cast<std::int64_t>(intervals.size()) > max_columns;
    std::vector<SpectrumColumn> columns;
    std::int64_t last = -1;
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        const SpectrumInterval& interval = intervals[i];
        const std::int64_t column = merges ? column_of(intervals, i, max_columns) : static_cast<std::int64_t>(i);
        if (column != last) {
            columns.push_back({interval.low, interval.high, 0, {interval.all, interval.all}, {interval.significant, interval.significant}});
        }
        last = column;
        SpectrumColumn& into = columns.back();
        into.low = interval.low;
        ++into.intervals;
        widen(into.all, interval.all);
        widen(into.significant, interval.significant);
    }
    return columns;
}

}  // namespace isoatlas
