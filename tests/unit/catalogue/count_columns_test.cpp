#include "catalogue/count_columns.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "oracle/compare.h"
#include "oracle/volumes.h"

namespace isoatlas {
namespace {

/// Descending intervals between 0 and `edges` with random counts.
std::vector<SpectrumInterval> random_intervals() {
    const int count = *rc::gen::inRange(1, 40);
    std::vector<SpectrumInterval> intervals;
    for (int i = count; i-- > 0;) {
        const LevelCounts counts{*rc::gen::inRange(0, 3), *rc::gen::inRange(0, 3), *rc::gen::inRange(0, 50), *rc::gen::inRange(0, 3)};
        intervals.push_back({static_cast<double>(i), i + 1.0, counts, {}});
    }
    return intervals;
}

// A column holds the least and the most of the intervals that it touches, and together they cover the range.
RC_GTEST_PROP(CountColumns, HoldWhatTheyCover, ()) {
    const std::vector<SpectrumInterval> intervals = random_intervals();
    const auto high = intervals.front().high;
    const double bend = *rc::gen::element(0.0, 0.5, 7.0), low = *rc::gen::element(0.0, 0.5);
    const std::vector<CountColumn> columns = count_columns(intervals, low, {0, high, bend}, *rc::gen::inRange(1, 50));
    RC_ASSERT(!columns.empty());
    RC_ASSERT(columns.front().low == low && columns.back().high == high);
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const CountColumn& column = columns[k];
        RC_ASSERT(column.low < column.high);
        if (k > 0) RC_ASSERT(column.low == columns[k - 1].high);
        std::vector<std::int64_t> inside;
        for (const SpectrumInterval& interval : intervals) {
            if (interval.high > column.low && interval.low < column.high) inside.push_back(interval.all.tunnels);
        }
        RC_ASSERT(column.min.tunnels == std::ranges::min(inside));
        RC_ASSERT(column.max.tunnels == std::ranges::max(inside));
    }
}

TEST(CountColumns, AreTheIntervalsWhenTheseAreFew) {
    const std::vector<SpectrumInterval> intervals{{2, 3, {1, 1, 0, 0}, {}}, {1, 2, {1, 1, 0, 0}, {}}, {-9, 1, {2, 2, 0, 0}, {}}};
    const std::vector<CountColumn> columns = count_columns(intervals, 0, {0, 3, 0}, 2);
    ASSERT_EQ(columns.size(), 2U);  // what is the same is joined
    EXPECT_EQ(columns[0].high, 1);
    EXPECT_EQ(columns[1].max.objects, 1);
    EXPECT_TRUE(count_columns({}, 0, {0, 3, 0}, 2).empty());
    EXPECT_TRUE(count_columns(intervals, 5, {5, 5, 0}, 2).empty());
}

// The intervals of a branch say of every isovalue what the events say.
RC_GTEST_PROP(BranchIntervals, FollowTheEventsDown, ()) {
    const Volume volume = oracle::to_volume(*oracle::arbitrary_grid());
    const Analysis analysis = analyse(volume);
    const double merges = analysis.event(EventId(analysis.event_count() - 1)).value - 1;
    for (const EventId id : ids<EventId>(analysis.event_count())) {
        if (analysis.event(id).objects_in > 0) continue;
        EventId event = id;
        for (const SpectrumInterval& interval : branch_intervals(analysis, id, merges)) {
            const Event there = analysis.event(event);
            RC_ASSERT(interval.high == there.value && interval.low == there.zone.tau_low);
            RC_ASSERT(interval.all == (LevelCounts{1, there.contours, there.b1, there.b2}));
            event = there.parent;
        }
        RC_ASSERT(!event.exists());
    }
}

}  // namespace
}  // namespace isoatlas
