#include "tree/criticality_tree.h"

#include <limits>
#include <utility>

#include "base/check.h"

namespace isoatlas {
namespace {

template <class Id>
constexpr Id kNone = std::numeric_limits<Id>::max();

/// Per element: the lowest element of its group of equal-valued join nodes.
template <class Id>
std::vector<Id> group_bottoms(std::span<const Id> join, std::span<const double> value) {
    const std::size_t n = value.size();
    std::vector<Id> bottom(n);
    for (std::size_t i = n; i-- > 0;) {
        const std::size_t next = join[i];
        bottom[i] = next < n && value[next] == value[i] ? bottom[next] : static_cast<Id>(i);
    }
    return bottom;
}

/// Numbers the groups with a non-trivial level by their highest element. event[b]: at bottoms of such groups.
template <class Id>
std::vector<Id> number_events(std::span<const Id> bottom, const Levels<Id>& levels, CriticalityTree<Id>& tree) {
    const std::size_t n = bottom.size();
    std::vector<Id> event(n, kNone<Id>);
    for (std::size_t i = 0; i < n; ++i) {
        if (levels.is_root(i) && !levels.is_trivial(i)) event[bottom[i]] = Id{0};  // kept; its number follows
    }
    std::vector<bool> numbered(n, false);
    for (std::size_t i = 0; i < n; ++i) {
        const Id b = bottom[i];
        if (event[b] == kNone<Id> || numbered[b]) continue;
        numbered[b] = true;
        event[b] = static_cast<Id>(tree.top.size());
        tree.top.push_back(static_cast<Id>(i));
    }
    return event;
}

/// Parents of events; event[b] of dropped groups becomes the next event above.
template <class Id>
void link_events(std::span<const Id> join, std::span<const Id> bottom, std::vector<Id>& event, CriticalityTree<Id>& tree) {
    const std::size_t n = bottom.size();
    // A dropped group has one child, so it is named by that child's event. Descending order: children come first.
    std::vector<bool> kept(n, false);
    for (std::size_t i = 0; i < n; ++i) kept[i] = bottom[i] == static_cast<Id>(i) && event[i] != kNone<Id>;
    tree.parent.resize(tree.size());
    for (std::size_t e = 0; e < tree.size(); ++e) tree.parent[e] = static_cast<Id>(e);
    for (std::size_t i = 0; i < n; ++i) {
        if (bottom[i] != static_cast<Id>(i)) continue;
        const std::size_t next = join[i];
        if (next == n) continue;
        const std::size_t next_bottom = bottom[next];
        if (kept[next_bottom]) {
            tree.parent[event[i]] = event[next_bottom];
        } else {
            ISOATLAS_CHECK(event[next_bottom] == kNone<Id>);
            event[next_bottom] = event[i];
        }
    }
}

template <class Id>
void add_levels(const Levels<Id>& levels, CriticalityTree<Id>& tree) {
    const std::size_t events = tree.size();
    tree.lows_out.resize(events);
    tree.contours.resize(events);
    tree.kind.resize(events);
    std::vector<bool> seen(events, false);
    for (std::size_t r = 0; r < levels.root.size(); ++r) {
        if (!levels.is_root(r) || levels.is_trivial(r)) continue;
        const std::size_t e = tree.event_of_element[r];
        const Criticality kind = levels.kind(r);
        tree.kind[e] = !seen[e] || tree.kind[e] == kind ? kind : Criticality::complex;
        seen[e] = true;
        tree.lows_out[e] += levels.out[r];
        tree.contours[e] += levels.out[r] - levels.in[r];  // wraps around and back: unsigned sums are exact modulo 2^bits
    }
}

}  // namespace

template <class Id>
CriticalityTree<Id> criticality_tree(std::span<const Id> join, const Levels<Id>& levels, std::span<const double> value,
                                     std::span<const std::int8_t> delta_chi) {
    using Signed = std::make_signed_t<Id>;
    const std::size_t n = value.size();
    CriticalityTree<Id> tree;
    std::vector<Id> bottom = group_bottoms(join, value);
    std::vector<Id> event = number_events<Id>(bottom, levels, tree);
    link_events<Id>(join, bottom, event, tree);
    for (std::size_t i = 0; i < n; ++i) bottom[i] = event[bottom[i]];
    tree.event_of_element = std::move(bottom);

    add_levels(levels, tree);
    tree.delta_chi.resize(tree.size());
    for (std::size_t i = 0; i < n; ++i) tree.delta_chi[tree.event_of_element[i]] += static_cast<Signed>(delta_chi[i]);
    tree.chi = tree.delta_chi;
    for (std::size_t e = 0; e < tree.size(); ++e) {
        if (tree.is_root(e)) continue;
        tree.chi[tree.parent[e]] += tree.chi[e];
        tree.contours[tree.parent[e]] += tree.contours[e];
    }
    // Below the root the object is the whole box: a ball with one contour.
    ISOATLAS_CHECK(tree.size() > 0 && tree.is_root(tree.size() - 1) && tree.chi.back() == 1 && tree.contours.back() == 1);
    return tree;
}

template CriticalityTree<std::uint32_t> criticality_tree(std::span<const std::uint32_t>, const Levels<std::uint32_t>&, std::span<const double>,
                                                         std::span<const std::int8_t>);
template CriticalityTree<std::uint64_t> criticality_tree(std::span<const std::uint64_t>, const Levels<std::uint64_t>&, std::span<const double>,
                                                         std::span<const std::int8_t>);

}  // namespace isoatlas
