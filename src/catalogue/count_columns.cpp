#include "catalogue/count_columns.h"

#include <algorithm>
#include <ranges>

#include "isoatlas/simplify.h"

namespace isoatlas {
namespace {

void widen(LevelCounts& min, LevelCounts& max, const LevelCounts& counts) {
    for (const auto member : {&LevelCounts::objects, &LevelCounts::contours, &LevelCounts::tunnels, &LevelCounts::cavities}) {
        min.*member = std::min(min.*member, counts.*member);
        max.*member = std::max(max.*member, counts.*member);
    }
}

CountColumn column_of(const SpectrumInterval& interval, double low, double high) {
    return {low, high, interval.all, interval.all, interval.significant, interval.significant};
}

/// Ascending, with equal neighbours joined.
std::vector<SpectrumInterval> clipped_intervals(std::span<const SpectrumInterval> intervals, double low, double high) {
    std::vector<SpectrumInterval> inside;
    for (const SpectrumInterval& whole : std::views::reverse(intervals)) {
        const SpectrumInterval clipped{std::max(whole.low, low), std::min(whole.high, high), whole.all, whole.significant};
        if (!(clipped.high > clipped.low)) continue;
        if (!inside.empty() && inside.back().all == clipped.all && inside.back().significant == clipped.significant) {
            inside.back().high = clipped.high;
        } else {
            inside.push_back(clipped);
        }
    }
    return inside;
}

}  // namespace

std::vector<CountColumn> count_columns(std::span<const SpectrumInterval> intervals, double low, const AxisScale& scale,
                                       std::int64_t columns) {
    const std::vector<SpectrumInterval> inside = clipped_intervals(intervals, low, scale.high);
    std::vector<CountColumn> result;
    if (static_cast<std::int64_t>(inside.size()) <= columns) {
        for (const SpectrumInterval& interval : inside) result.push_back(column_of(interval, interval.low, interval.high));
        return result;
    }
    const double begin = scale.position(inside.front().low), end = scale.position(inside.back().high);
    std::size_t first = 0;
    double left = inside.front().low;
    for (std::int64_t k = 1; k <= columns; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(columns);
        const double right = k == columns ? inside.back().high : scale.tau(begin + (end - begin) * part);
        while (first + 1 < inside.size() && inside[first].high <= left) ++first;
        CountColumn column = column_of(inside[first], left, right);
        for (std::size_t i = first; i < inside.size() && inside[i].low < right; ++i) {
            widen(column.min, column.max, inside[i].all);
            widen(column.min_significant, column.max_significant, inside[i].significant);
        }
        result.push_back(column);
        left = right;
    }
    return result;
}

std::vector<SpectrumInterval> branch_intervals(const Analysis& analysis, EventId branch_top, double merges) {
    std::vector<SpectrumInterval> intervals;
    for (const EventId id : events_of(analysis, branch_top, merges)) {
        const Event event = analysis.event(id);
        intervals.push_back({event.zone.tau_low, event.value, {1, event.contours, event.b1, event.b2}, {}});
    }
    return intervals;
}

}  // namespace isoatlas
