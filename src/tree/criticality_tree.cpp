#include "tree/criticality_tree.h"

#include <limits>
#include <utility>

#include "base/check.h"

namespace isoatlas {
namespace {

template <class Id>
constexpr Id kNone = std::numeric_limits<Id>::max();

/// Numbers the groups with a non-trivial level by their highest element. event[b]: at bottoms of such groups.
template <class Id>
BigVector<Id> number_events(std::span<const Id> bottom, std::span<const Id> level, const LevelFlow<Id>& flow, CriticalityTree<Id>& tree) {
    const std::size_t n = bottom.size();
    constexpr Id kKept = kNone<Id> - 1;  // to be numbered
    BigVector<Id> event(n, kNone<Id>);
    std::size_t events = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (level[i] != static_cast<Id>(i) || flow.is_trivial(i)) continue;
        events += event[bottom[i]] == kNone<Id>;
        event[bottom[i]] = kKept;
    }
    tree.top.reserve(events);
    for (std::size_t i = 0; i < n; ++i) {
        Id& number = event[bottom[i]];
        if (number != kKept) continue;
        number = static_cast<Id>(tree.top.size());
        tree.top.push_back(static_cast<Id>(i));
    }
    return event;
}

/// Parents of events; event[b] of dropped groups becomes the next event above. Groups in descending order: children come first.
template <class Id>
void link_events(std::span<const Id> join, std::span<const Id> bottom, BigVector<Id>& event, CriticalityTree<Id>& tree) {
    const std::size_t n = bottom.size();
    std::vector<bool> kept(n, false);
    for (std::size_t i = 0; i < n; ++i) kept[i] = event[i] != kNone<Id>;
    tree.parent.resize(tree.size());
    for (std::size_t e = 0; e < tree.size(); ++e) tree.parent[e] = static_cast<Id>(e);
    for (std::size_t i = 0; i < n; ++i) {
        if (bottom[i] != static_cast<Id>(i) || join[i] == static_cast<Id>(n)) continue;
        const std::size_t next = bottom[join[i]];
        if (kept[next]) {
            tree.parent[event[i]] = event[next];
        } else {
            ISOATLAS_CHECK(event[next] == kNone<Id>);  // a dropped group has one child: it goes by the child's name
            event[next] = event[i];
        }
    }
}

}  // namespace

template <class Id>
BigVector<Id> join_groups(std::span<const Id> join, std::span<const double> value) {
    const std::size_t n = value.size();
    BigVector<Id> bottom(n);
    for (std::size_t i = n; i-- > 0;) {
        const std::size_t next = join[i];
        bottom[i] = next < n && value[next] == value[i] ? bottom[next] : static_cast<Id>(i);
    }
    return bottom;
}

template <class Id>
CriticalityTree<Id> criticality_tree(BigVector<Id> group, std::span<const Id> join, std::span<const Id> level, const LevelFlow<Id>& flow) {
    CriticalityTree<Id> tree;
    BigVector<Id>& bottom = group;
    BigVector<Id> event = number_events<Id>(bottom, level, flow, tree);
    link_events<Id>(join, bottom, event, tree);
    for (Id& b : bottom) b = event[b];
    tree.event_of_element = std::move(bottom);
    ISOATLAS_CHECK(tree.size() > 0 && tree.is_root(tree.size() - 1));
    return tree;
}

template <class Id>
EventMeasures<Id> gather_levels(const CriticalityTree<Id>& tree, std::span<const Id> level, const LevelFlow<Id>& flow) {
    const std::size_t events = tree.size();
    EventMeasures<Id> measures;
    measures.lows_out.assign(events, Id{0});
    measures.contours.assign(events, Id{0});
    measures.kind.assign(events, Criticality::complex);
    for (std::size_t r = 0; r < level.size(); ++r) {
        if (level[r] != static_cast<Id>(r) || flow.is_trivial(r)) continue;
        const std::size_t e = tree.event_of_element[r];
        const Criticality kind = flow.kind(r);
        const bool first = measures.lows_out[e] == 0 && measures.contours[e] == 0;  // every non-trivial level changes one of them or more
        measures.kind[e] = first || measures.kind[e] == kind ? kind : Criticality::complex;
        measures.lows_out[e] += flow.out[r].contours;
        measures.contours[e] += flow.out[r].contours - flow.in[r].contours;  // unsigned sums wrap around and back
    }
    return measures;
}

template <class Id>
void sum_objects(const CriticalityTree<Id>& tree, std::span<const std::int8_t> delta_chi, EventMeasures<Id>& measures) {
    using Signed = std::make_signed_t<Id>;
    measures.delta_chi.assign(tree.size(), Signed{0});
    for (std::size_t i = 0; i < delta_chi.size(); ++i) measures.delta_chi[tree.event_of_element[i]] += static_cast<Signed>(delta_chi[i]);
    measures.chi = measures.delta_chi;
    for (std::size_t e = 0; e < tree.size(); ++e) {
        if (tree.is_root(e)) continue;
        measures.chi[tree.parent[e]] += measures.chi[e];
        measures.contours[tree.parent[e]] += measures.contours[e];
    }
    // Below the root the object is the whole box: a ball with one contour.
    ISOATLAS_CHECK(measures.chi.back() == 1 && measures.contours.back() == 1);
}

#define ISOATLAS_CRITICALITY_TREE(Id)                                                                                                  \
    template BigVector<Id> join_groups(std::span<const Id>, std::span<const double>);                                                      \
    template CriticalityTree<Id> criticality_tree(BigVector<Id>, std::span<const Id>, std::span<const Id>, const LevelFlow<Id>&);         \
    template EventMeasures<Id> gather_levels(const CriticalityTree<Id>&, std::span<const Id>, const LevelFlow<Id>&);           \
    template void sum_objects(const CriticalityTree<Id>&, std::span<const std::int8_t>, EventMeasures<Id>&);
ISOATLAS_CRITICALITY_TREE(std::uint32_t)
ISOATLAS_CRITICALITY_TREE(std::uint64_t)
#undef ISOATLAS_CRITICALITY_TREE

}  // namespace isoatlas
