#include "catalogue/count_columns.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "analysis/event_alone.h"
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

/// The parts of intervals in (low, high], ascending; inner ones of events with equal values are empty.
class Clipped {
public:
    Clipped(std::span<const SpectrumInterval> intervals, double low, double high) : intervals_(intervals), low_(low), high_(high) {
        while (!intervals_.empty() && !is_inside(intervals_.back())) intervals_ = intervals_.first(intervals_.size() - 1);
        while (!intervals_.empty() && !is_inside(intervals_.front())) intervals_ = intervals_.subspan(1);
    }
    [[nodiscard]] std::size_t size() const { return intervals_.size(); }
    [[nodiscard]] SpectrumInterval operator[](std::size_t i) const {
        const SpectrumInterval& whole = intervals_[intervals_.size() - 1 - i];
        return {std::max(whole.low, low_), std::min(whole.high, high_), whole.all, whole.significant};
    }

private:
    [[nodiscard]] bool is_inside(const SpectrumInterval& whole) const { return std::min(whole.high, high_) > std::max(whole.low, low_); }

    std::span<const SpectrumInterval> intervals_;
    double low_, high_;
};

/// With equal neighbours joined; nullopt: there are more than `most`.
std::optional<std::vector<CountColumn>> joined_columns(const Clipped& inside, std::int64_t most) {
    std::vector<CountColumn> result;
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const SpectrumInterval interval = inside[i];
        if (!(interval.high > interval.low)) continue;
        if (!result.empty() && result.back().min == interval.all && result.back().min_significant == interval.significant) {
            result.back().high = interval.high;
            continue;
        }
        if (std::ssize(result) == most) return std::nullopt;
        result.push_back(column_of(interval, interval.low, interval.high));
    }
    return result;
}

}  // namespace

std::vector<CountColumn> count_columns(std::span<const SpectrumInterval> intervals, double low, const AxisScale& scale,
                                       std::int64_t columns) {
    const Clipped inside(intervals, low, scale.high);
    if (std::optional<std::vector<CountColumn>> all = joined_columns(inside, columns)) return std::move(*all);
    std::vector<CountColumn> result;
    const double lowest = inside[0].low, highest = inside[inside.size() - 1].high;
    const double begin = scale.position(lowest), end = scale.position(highest);
    std::size_t first = 0;
    double left = lowest;
    for (std::int64_t k = 1; k <= columns; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(columns);
        const double right = k == columns ? highest : scale.tau(begin + (end - begin) * part);
        while (first + 1 < inside.size() && inside[first].high <= left) ++first;
        CountColumn column = column_of(inside[first], left, right);
        for (std::size_t i = first; i < inside.size() && inside[i].low < right; ++i) {
            if (!(inside[i].high > inside[i].low)) continue;
            widen(column.min, column.max, inside[i].all);
            widen(column.min_significant, column.max_significant, inside[i].significant);
        }
        result.push_back(column);
        left = right;
    }
    return result;
}

std::vector<SpectrumInterval> branch_intervals(const Analysis& analysis, EventId branch_top, double merges) {
    const std::vector<EventId> events = events_of(analysis, branch_top, merges);
    std::vector<SpectrumInterval> intervals;
    intervals.reserve(events.size());
    for (const EventId id : events) {
        const Event event = event_alone(analysis.data(), id);
        intervals.push_back({event.zone.tau_low, event.value, {1, event.contours, event.b1, event.b2}, {}});
    }
    return intervals;
}

}  // namespace isoatlas
