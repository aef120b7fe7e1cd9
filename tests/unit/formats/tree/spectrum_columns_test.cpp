// A spectrum in few columns: they cover every interval once, in order, with the range of each count.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "formats/tree/spectrum_columns.h"

using namespace isoatlas;

namespace {

/// Descending intervals; some values far from the others, as fill values are.
Spectrum random_spectrum() {
    Spectrum spectrum;
    double high = *rc::gen::element(10.0, 1e20, 1.7e308);
    const int count = *rc::gen::inRange(0, 300);
    for (int i = 0; i < count; ++i) {
        const double low = i + 1 == count ? -std::numeric_limits<double>::infinity() : high > 1e6 ? 1000.0 : high - *rc::gen::inRange(1, 9);
        const auto counts = [] {
            return LevelCounts{*rc::gen::inRange<std::int64_t>(0, 9), *rc::gen::inRange<std::int64_t>(0, 9),
                               *rc::gen::inRange<std::int64_t>(0, 9), *rc::gen::inRange<std::int64_t>(0, 9)};
        };
        spectrum.intervals.push_back({low, high, counts(), counts()});
        high = low;
    }
    return spectrum;
}

void check_range(const std::vector<SpectrumInterval>& intervals, std::size_t first, const SpectrumColumn& column,
                 LevelCounts SpectrumInterval::* counts, CountRange SpectrumColumn::* range) {
    for (const auto count : {&LevelCounts::objects, &LevelCounts::contours, &LevelCounts::tunnels, &LevelCounts::cavities}) {
        std::int64_t min = std::numeric_limits<std::int64_t>::max(), max = -1;
        for (std::size_t i = first; i < first + static_cast<std::size_t>(column.intervals); ++i) {
            min = std::min(min, intervals[i].*counts.*count);
            max = std::max(max, intervals[i].*counts.*count);
        }
        const bool is_range = (column.*range).min.*count == min && (column.*range).max.*count == max;
        RC_ASSERT(is_range);
    }
}

RC_GTEST_PROP(SpectrumColumns, cover_every_interval_once, ()) {
    const Spectrum spectrum = random_spectrum();
    const std::int64_t max_columns = *rc::gen::element<std::int64_t>(0, 1, 2, 16, 100);
    const std::vector<SpectrumColumn> columns = spectrum_columns(spectrum, max_columns);
    const auto count = static_cast<std::int64_t>(spectrum.intervals.size());
    RC_ASSERT(max_columns == 0 || static_cast<std::int64_t>(columns.size()) <= max_columns);
    if (max_columns == 0 || count <= max_columns) RC_ASSERT(static_cast<std::int64_t>(columns.size()) == count);
    std::size_t at = 0;
    for (const SpectrumColumn& column : columns) {
        RC_ASSERT(column.intervals >= 1);
        RC_ASSERT(column.high == spectrum.intervals.at(at).high);
        check_range(spectrum.intervals, at, column, &SpectrumInterval::all, &SpectrumColumn::all);
        check_range(spectrum.intervals, at, column, &SpectrumInterval::significant, &SpectrumColumn::significant);
        if (max_columns > 0) RC_ASSERT(column.intervals <= 2 * (count / max_columns + 1));
        at += static_cast<std::size_t>(column.intervals);
        RC_ASSERT(column.low == spectrum.intervals.at(at - 1).low);
    }
    RC_ASSERT(at == spectrum.intervals.size());
}

}  // namespace
