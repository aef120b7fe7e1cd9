#include "tree/criticality_tree.h"

#include <limits>
#include <utility>

#include "base/check.h"
#include "base/memory_limit.h"
#include "base/paced_fill.h"
#include "base/parallel.h"

namespace isoatlas {
namespace {

template <class Id>
constexpr Id kNone = std::numeric_limits<Id>::max();
constexpr std::size_t kAhead = 16;  // what a parent needs is fetched so many elements before

/// Numbers the groups with a non-trivial level by their highest element. event[b]: at bottoms of such groups.
template <class Id>
BigVector<Id> number_events(std::span<const Id> bottom, std::span<const Id> level, std::span<const LevelKind> kind,
                            CriticalityTree<Id>& tree) {
    const std::size_t n = bottom.size();
    constexpr Id kKept = kNone<Id> - 1;  // to be numbered
    BigVector<Id> event = filled<Id>(n, kNone<Id>);
    std::size_t events = 0;
    BudgetPoll memory;
    for (std::size_t i = 0; i < n; ++i) {
        memory.step(BudgetPoll::kTouch);
        if (level[i] != static_cast<Id>(i) || kind[i] == LevelKind::trivial) continue;
        events += event[bottom[i]] == kNone<Id>;
        event[bottom[i]] = kKept;
    }
    tree.top.reserve(events);
    for (std::size_t i = 0; i < n; ++i) {
        memory.step(BudgetPoll::kTouch);
        Id& number = event[bottom[i]];
        if (number != kKept) continue;
        number = static_cast<Id>(tree.top.size());
        tree.top.push_back(static_cast<Id>(i));
    }
    return event;
}

/// The kind of an event: that of its non-trivial levels when they agree.
template <class Id>
void gather_kinds(const CriticalityTree<Id>& tree, std::span<const Id> level, std::span<const LevelKind> kind,
                  EventMeasures<Id>& measures) {
    std::vector<bool> seen(tree.size(), false);
    measures.kind.resize(tree.size());
    BudgetPoll memory;
    for (std::size_t r = 0; r < level.size(); ++r) {
        memory.step(BudgetPoll::kTouch);
        if (level[r] != static_cast<Id>(r) || kind[r] == LevelKind::trivial) continue;
        const std::size_t e = tree.event_of_element[r];
        const auto own = static_cast<Criticality>(kind[r]);
        measures.kind[e] = !seen[e] || measures.kind[e] == own ? own : Criticality::complex;
        seen[e] = true;
    }
}
static_assert(static_cast<int>(LevelKind::complex) == static_cast<int>(Criticality::complex));

/// Parents of events; event[b] of dropped groups becomes the next event above. Groups in descending order: children come first.
template <class Id>
void link_events(std::span<const Id> join, std::span<const Id> bottom, BigVector<Id>& event, CriticalityTree<Id>& tree) {
    const std::size_t n = bottom.size();
    BigVector<std::uint8_t> kept(n);
    for (std::size_t i = 0; i < n; ++i) kept[i] = event[i] != kNone<Id>;
    tree.parent.resize(tree.size());
    for (std::size_t e = 0; e < tree.size(); ++e) tree.parent[e] = static_cast<Id>(e);
    BudgetPoll memory;
    for (std::size_t i = 0; i < n; ++i) {
        memory.step(3 * BudgetPoll::kTouch);
        if (i + kAhead < n && join[i + kAhead] < n) {  // most groups have one element
            __builtin_prefetch(&bottom[join[i + kAhead]]);
            __builtin_prefetch(&event[join[i + kAhead]], 1);
        }
        if (bottom[i] != static_cast<Id>(i) || join[i] == static_cast<Id>(n)) continue;
        const std::size_t next = bottom[join[i]];
        if (kept[next]) {
            tree.parent[event[i]] = event[next];
        } else {
            ISOATLAS_CHECK(event[next] == kNone<Id>);  // a dropped group has one child and takes its number
            event[next] = event[i];
        }
    }
}

}  // namespace

template <class Id>
BigVector<Id> join_groups(std::span<const Id> join, std::span<const double> value) {
    const std::size_t n = value.size();
    BigVector<Id> bottom(n);
    BudgetPoll memory;
    for (std::size_t i = n; i-- > 0;) {
        memory.step(BudgetPoll::kTouch);
        const std::size_t next = join[i];
        bottom[i] = next < n && value[next] == value[i] ? bottom[next] : static_cast<Id>(i);
    }
    return bottom;
}

template <class Id>
CriticalityTree<Id> criticality_tree(BigVector<Id> group, std::span<const Id> join, std::span<const Id> level,
                                     std::span<const LevelKind> kind) {
    CriticalityTree<Id> tree;
    BigVector<Id>& bottom = group;
    BigVector<Id> event = number_events<Id>(bottom, level, kind, tree);
    link_events<Id>(join, bottom, event, tree);
    BudgetPoll memory;
    for (Id& b : bottom) {
        memory.step(BudgetPoll::kTouch);
        b = event[b];
    }
    tree.event_of_element = std::move(bottom);
    ISOATLAS_CHECK(tree.size() > 0 && tree.is_root(tree.size() - 1));
    return tree;
}

template <class Id>
EventMeasures<Id> measure_events(const CriticalityTree<Id>& tree, const ContourTree<Id>& contours, std::span<const Id> level,
                                 std::span<const LevelKind> kind, std::span<const std::int8_t> delta_chi, int threads) {
    using Signed = std::make_signed_t<Id>;
    const std::size_t n = level.size(), events = tree.size();
    const auto sum_over_objects = [&](auto& count) {
        BudgetPoll memory;
        for (std::size_t e = 0; e < events; ++e) {
            memory.step(BudgetPoll::kTouch);
            if (!tree.is_root(e)) count[tree.parent[e]] += count[e];
        }
    };
    EventMeasures<Id> measures;
    // Arcs of no length, and trivial levels, have as many ends above as below: they do not count.
    const auto count_contours = [&] {
        fill_fresh(measures.lows_out, events, Id{0});
        fill_fresh(measures.contours, events, Id{0});
        BudgetPoll memory;
        for (std::size_t i = 0; i < n; ++i) {
            memory.step(3 * BudgetPoll::kTouch);
            const Id e = tree.event_of_element[i];
            measures.contours[e] += static_cast<Id>(contours.below(i) - contours.above(i));  // wraps around and back
            const bool joins = level[i] != static_cast<Id>(i);                               // by an arc of no length
            if (kind[level[i]] != LevelKind::trivial) measures.lows_out[e] += static_cast<Id>(contours.below(i) - joins);
        }
        sum_over_objects(measures.contours);
    };
    const auto sum_chi = [&] {
        gather_kinds<Id>(tree, level, kind, measures);
        fill_fresh(measures.delta_chi, events, Signed{0});
        BudgetPoll memory;
        for (std::size_t i = 0; i < n; ++i) {
            memory.step(BudgetPoll::kTouch);
            measures.delta_chi[tree.event_of_element[i]] += static_cast<Signed>(delta_chi[i]);
        }
        measures.chi.resize(events);
        for (std::size_t e = 0; e < events; ++e) measures.chi[e] = measures.delta_chi[e], memory.step();
        sum_over_objects(measures.chi);
    };
    run_both(threads, count_contours, sum_chi);
    // Below the root the object is the whole box: a ball with one contour.
    ISOATLAS_CHECK(measures.chi.back() == 1 && measures.contours.back() == 1);
    return measures;
}

#define ISOATLAS_CRITICALITY_TREE(Id)                                                                                                   \
    template BigVector<Id> join_groups(std::span<const Id>, std::span<const double>);                                                   \
    template CriticalityTree<Id> criticality_tree(BigVector<Id>, std::span<const Id>, std::span<const Id>, std::span<const LevelKind>); \
    template EventMeasures<Id> measure_events(const CriticalityTree<Id>&, const ContourTree<Id>&, std::span<const Id>,                  \
                                              std::span<const LevelKind>, std::span<const std::int8_t>, int);
ISOATLAS_CRITICALITY_TREE(std::uint32_t)
ISOATLAS_CRITICALITY_TREE(std::uint64_t)
#undef ISOATLAS_CRITICALITY_TREE

}  // namespace isoatlas
