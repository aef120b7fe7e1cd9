#include "tree/criticality_tree.h"
#include "tree/contour_tree.h"

#include <utility>

#include "base/check.h"
#include "base/paced_fill.h"
#include "base/parallel.h"
#include "base/streamed.h"

namespace isoatlas {
namespace {

constexpr std::size_t kElementsAhead = 16;  // what a parent needs is fetched so many elements before

/// Numbers the groups with a non-trivial level by their highest element. event[b]: at bottoms of such groups.
template <class Number>
ByElement<Number, EventIdOf<Number>> number_events(ByElementView<Number, ElementIdOf<Number>> bottom,
                                                   ByElementView<Number, ElementIdOf<Number>> level, ByElementView<Number, LevelKind> kind,
                                                   CriticalityTree<Number>& tree) {
    using Element = ElementIdOf<Number>;
    using Event = EventIdOf<Number>;
    const std::size_t n = bottom.size();
    constexpr Event kKept = Event::none().previous();  // to be numbered
    ByElement<Number, Event> event(filled(n, Event::none()));
    std::size_t events = 0;
    for (const Element i : streamed<Element>(n, at_random())) {
        if (level[i] != i || kind[i] == LevelKind::trivial) continue;
        events += !event[bottom[i]].exists();
        event[bottom[i]] = kKept;
    }
    tree.top.items().reserve(events);
    for (const Element i : streamed<Element>(n, at_random())) {
        Event& number = event[bottom[i]];
        if (number != kKept) continue;
        number = Event(tree.top.size());
        tree.top.push_back(i);
    }
    return event;
}

/// The kind of an event: that of its non-trivial levels when they agree.
template <class Number>
void gather_kinds(const CriticalityTree<Number>& tree, ByElementView<Number, ElementIdOf<Number>> level,
                  ByElementView<Number, LevelKind> kind, EventMeasures<Number>& measures) {
    using Element = ElementIdOf<Number>;
    std::vector<bool> seen(tree.size(), false);
    measures.kind.items().resize(tree.size());
    for (const Element r : streamed<Element>(level.size(), at_random())) {
        if (level[r] != r || kind[r] == LevelKind::trivial) continue;
        const EventIdOf<Number> e = tree.event_of_element[r];
        const auto own = static_cast<Criticality>(kind[r]);
        measures.kind[e] = !seen[e.index()] || measures.kind[e] == own ? own : Criticality::complex;
        seen[e.index()] = true;
    }
}
static_assert(static_cast<int>(LevelKind::complex) == static_cast<int>(Criticality::complex));

/// Parents of events; event[b] of dropped groups becomes the next event above. Groups in descending order: children come first.
template <class Number>
void link_events(MergeTreeView<Number> join, ByElementView<Number, ElementIdOf<Number>> bottom, ByElement<Number, EventIdOf<Number>>& event,
                 CriticalityTree<Number>& tree) {
    using Element = ElementIdOf<Number>;
    const std::size_t n = bottom.size();
    const Element outside(n);
    ByElement<Number, std::uint8_t> kept(n);
    for (const Element i : kept.ids()) kept[i] = event[i].exists();
    tree.parent.items().resize(tree.size());
    for (const EventIdOf<Number> e : tree.parent.ids()) tree.parent[e] = e;
    for (const Element i : streamed<Element>(n, at_random(3))) {
        if (const Element ahead(i.index() + kElementsAhead); ahead < outside && join[ahead] < outside) {  // most groups have one element
            __builtin_prefetch(&bottom[join[ahead]]);
            __builtin_prefetch(&event[join[ahead]], 1);
        }
        if (bottom[i] != i || join[i] == outside) continue;
        const Element next = bottom[join[i]];
        if (kept[next]) {
            tree.parent[event[i]] = event[next];
        } else {
            ISOATLAS_CHECK(!event[next].exists());  // a dropped group has one child and takes its number
            event[next] = event[i];
        }
    }
}

}  // namespace

template <class Number>
ByElement<Number, ElementIdOf<Number>> join_groups(MergeTreeView<Number> join, ByElementView<Number, double> value) {
    using Element = ElementIdOf<Number>;
    ByElement<Number, Element> bottom(value.size());
    const Element outside(value.size());
    for (const Element i : streamed_down<Element>(value.size(), at_random())) {
        const Element next = join[i];
        bottom[i] = next < outside && has_equal(value, i) && value[next] == value[i] ? bottom[next] : i;
    }
    return bottom;
}

template <class Number>
CriticalityTree<Number> criticality_tree(ByElement<Number, ElementIdOf<Number>> group, MergeTreeView<Number> join,
                                         ByElementView<Number, ElementIdOf<Number>> level, ByElementView<Number, LevelKind> kind,
                                         int threads) {
    using Element = ElementIdOf<Number>;
    CriticalityTree<Number> tree;
    ByElement<Number, EventIdOf<Number>> event = number_events<Number>(group, level, kind, tree);
    link_events<Number>(join, group, event, tree);
    for_each_index(threads, group.size(), [&](std::size_t i) {  // in place: bottoms keep theirs
        if (const Element x(i); group[x] != x) event[x] = event[group[x]];
    });
    tree.event_of_element = std::move(event);
    ISOATLAS_CHECK(tree.size() > 0 && tree.is_root(tree.root()));
    return tree;
}

template <class Number>
EventMeasures<Number> measure_events(const CriticalityTree<Number>& tree, const ContourTree<Number>& contours,
                                     ByElementView<Number, ElementIdOf<Number>> level, ByElementView<Number, LevelKind> kind,
                                     ByElementView<Number, std::int8_t> delta_chi, int threads) {
    using Element = ElementIdOf<Number>;
    using Event = EventIdOf<Number>;
    using Signed = std::make_signed_t<Number>;
    const std::size_t n = level.size(), events = tree.size();
    const auto sum_over_objects = [&](auto& count) {
        for (const Event e : streamed<Event>(events, at_random())) {
            if (!tree.is_root(e)) count[tree.parent[e]] += count[e];
        }
    };
    EventMeasures<Number> measures;
    // Arcs of no length, and trivial levels, have as many ends above as below: they do not count.
    const auto count_contours = [&] {
        fill_fresh(measures.lows_out.items(), events, Number{0});
        fill_fresh(measures.contours.items(), events, Number{0});
        for (const Element i : streamed<Element>(n, at_random(3))) {
            const Event e = tree.event_of_element[i];
            measures.contours[e] += static_cast<Number>(contours.below(i) - contours.above(i));  // wraps around and back
            const bool joins = level[i] != i;                                                    // by an arc of no length
            if (kind[level[i]] != LevelKind::trivial) measures.lows_out[e] += static_cast<Number>(contours.below(i) - joins);
        }
        sum_over_objects(measures.contours);
    };
    const auto sum_chi = [&] {
        gather_kinds<Number>(tree, level, kind, measures);
        fill_fresh(measures.delta_chi.items(), events, Signed{0});
        for (const Element i : streamed<Element>(n, at_random())) {
            measures.delta_chi[tree.event_of_element[i]] += static_cast<Signed>(delta_chi[i]);
        }
        measures.chi.items().resize(events);
        for (const Event e : streamed<Event>(events, in_order(8))) measures.chi[e] = measures.delta_chi[e];
        sum_over_objects(measures.chi);
    };
    run_both(threads, count_contours, sum_chi);
    // Below the root the object is the whole box: a ball with one contour.
    ISOATLAS_CHECK(measures.chi[tree.root()] == 1 && measures.contours[tree.root()] == 1);
    return measures;
}

#define ISOATLAS_CRITICALITY_TREE(Number)                                                                                            \
    template MergeTree<Number> join_groups(MergeTreeView<Number>, ByElementView<Number, double>);                                    \
    template CriticalityTree<Number> criticality_tree(MergeTree<Number>, MergeTreeView<Number>, MergeTreeView<Number>,               \
                                                      ByElementView<Number, LevelKind>, int);                                        \
    template EventMeasures<Number> measure_events(const CriticalityTree<Number>&, const ContourTree<Number>&, MergeTreeView<Number>, \
                                                  ByElementView<Number, LevelKind>, ByElementView<Number, std::int8_t>, int);
ISOATLAS_CRITICALITY_TREE(std::uint32_t)
ISOATLAS_CRITICALITY_TREE(std::uint64_t)
#undef ISOATLAS_CRITICALITY_TREE

}  // namespace isoatlas
