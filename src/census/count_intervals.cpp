#include "census/count_intervals.h"

#include <limits>

#include "analysis/analysis_data.h"
#include "isoatlas/error.h"
#include "isoatlas/objects.h"
#include "isoatlas/spectrum.h"

namespace isoatlas {
namespace {

template <class Id>
double value_of(const AnalysisArrays<Id>& arrays, EventIdOf<Id> event) {
    return arrays.value[arrays.tree.top[event]];
}

template <class Id>
LevelCounts counts_of(const AnalysisArrays<Id>& arrays, EventIdOf<Id> event, int rank) {
    LevelCounts counts{1, static_cast<std::int64_t>(arrays.measures.contours[event]), 0, 0};
    counts.cavities = rank == 3 ? counts.contours - 1 : 0;
    counts.tunnels = 1 + counts.cavities - static_cast<std::int64_t>(arrays.measures.chi[event]);
    return counts;
}

/// Of different events.
template <class Id>
std::size_t count_values(const AnalysisArrays<Id>& arrays) {
    std::size_t count = 0;
    double last = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t e = 0; e < arrays.tree.size(); ++e) {
        const double value = value_of(arrays, EventIdOf<Id>(e));
        count += value != last;
        last = value;
    }
    return count;
}

void add(LevelCounts& counts, const LevelCounts& more, std::int64_t times) {
    counts.objects += times * more.objects, counts.contours += times * more.contours;
    counts.tunnels += times * more.tunnels, counts.cavities += times * more.cavities;
}

[[noreturn]] void contradiction() {
    throw Error(
        ErrorKind::input,
        {.where = "objects", .what = "the table of objects does not belong to the trees", .next = "build the store again from the volume"});
}

}  // namespace

template <class Id>
std::vector<bool> events_of_entries(const AnalysisArrays<Id>& arrays, const std::vector<ObjectEntry>& entries) {
    const CriticalityTree<Id>& tree = arrays.tree;
    std::vector<bool> significant(tree.size(), false);
    for (const ObjectEntry& entry : entries) {
        if (entry.branch_top < EventId(0) || entry.branch_top >= EventId(tree.size())) contradiction();
        for (EventIdOf<Id> e(entry.branch_top.number()); value_of(arrays, e) > entry.merges; e = tree.parent[e]) {
            if (significant[e.index()]) break;  // another entry of the branch: branches share no event
            significant[e.index()] = true;
            if (tree.is_root(e)) break;
        }
    }
    return significant;
}

// Events come in descending order. A zone begins to count at its own value and ends at that of its parent.
template <class Id>
std::vector<SpectrumInterval> count_intervals(const AnalysisArrays<Id>& arrays, int rank, const std::vector<bool>& significant) {
    const CriticalityTree<Id>& tree = arrays.tree;
    std::vector<SpectrumInterval> intervals;
    intervals.reserve(count_values(arrays));  // a growing vector is held twice
    ByEvent<Id, Id> place(tree.size());
    for (const EventIdOf<Id> e : place.ids()) {
        const double value = value_of(arrays, e);
        if (intervals.empty() || intervals.back().high != value)
            intervals.push_back({-std::numeric_limits<double>::infinity(), value, {}, {}});
        place[e] = static_cast<Id>(intervals.size() - 1);
    }
    for (const EventIdOf<Id> e : place.ids()) {
        const LevelCounts counts = counts_of(arrays, e, rank);
        const auto change = [&](SpectrumInterval& interval, std::int64_t times) {
            add(interval.all, counts, times);
            if (significant[e.index()]) add(interval.significant, counts, times);
        };
        change(intervals[place[e]], 1);
        if (!tree.is_root(e)) change(intervals[place[tree.parent[e]]], -1);
    }
    for (std::size_t i = 1; i < intervals.size(); ++i) {
        intervals[i - 1].low = intervals[i].high;
        add(intervals[i].all, intervals[i - 1].all, 1);
        add(intervals[i].significant, intervals[i - 1].significant, 1);
    }
    return intervals;
}

std::vector<SpectrumInterval> count_intervals(const Analysis& analysis, const ObjectTable& table) {
    return analysis.data().visit([&](const auto& held) {
        return count_intervals(held.arrays, analysis.extent().rank, events_of_entries(held.arrays, table.entries));
    });
}

#define ISOATLAS_COUNT_INTERVALS(Id)                                                                          \
    template std::vector<bool> events_of_entries(const AnalysisArrays<Id>&, const std::vector<ObjectEntry>&); \
    template std::vector<SpectrumInterval> count_intervals(const AnalysisArrays<Id>&, int, const std::vector<bool>& significant);
ISOATLAS_COUNT_INTERVALS(std::uint32_t)
ISOATLAS_COUNT_INTERVALS(std::uint64_t)
#undef ISOATLAS_COUNT_INTERVALS

}  // namespace isoatlas
