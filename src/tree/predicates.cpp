#include "tree/predicates.h"

#include <limits>

#include "base/paced_fill.h"
#include "base/streamed.h"

namespace isoatlas {
namespace {

template <class Number>
std::string text(Number number) {
    return std::to_string(number);
}
template <class Tag, class Number>
std::string text(StrongId<Tag, Number> id) {
    return std::to_string(id.number());
}

template <class I>
Verdict violated(const char* what, I node, const std::string& how) {
    return Verdict(what + (" " + text(node)) + " " + how);
}

constexpr std::uint8_t kMaxBranches = 2;  // above an element, and below

/// How many children every node has. The parents must be nodes.
template <class Number>
ByElement<Number, std::uint8_t> children_of(MergeTreeView<Number> parent) {
    using Element = ElementIdOf<Number>;
    ByElement<Number, std::uint8_t> count(filled(parent.size(), std::uint8_t{0}));
    for (const Element x : streamed<Element>(parent.size(), at_random())) {
        if (std::uint8_t& of = count[parent[x]]; parent[x] != x && of <= kMaxBranches) ++of;
    }
    return count;
}

template <class Number>
Verdict at_most_two_children(const ByElement<Number, std::uint8_t>& children) {
    for (const auto x : children.ids()) {
        if (children[x] > kMaxBranches) return violated("node", x, "has more than two children");
    }
    return {};
}

/// Degrees of a contour tree counted from its arcs, as in ContourTree::degree.
template <class Number>
struct Degrees {
    using Element = ElementIdOf<Number>;
    ByElement<Number, std::uint8_t> degree;
    Verdict verdict;

    explicit Degrees(const ContourTree<Number>& tree) : degree(filled(tree.nodes(), std::uint8_t{0})) {
        for (const Element x : streamed<Element>(tree.nodes(), at_random())) {
            if (tree.other[x].index() >= tree.nodes()) verdict = violated("node", x, "has an arc to no node");
            if (verdict && tree.has_arc(x)) add(tree.upper(x), tree.lower(x));
            if (!verdict) return;
        }
    }
    [[nodiscard]] int above(Element x) const { return degree[x] & 3; }
    [[nodiscard]] int below(Element x) const { return degree[x] >> 2; }

private:
    void add(Element upper, Element lower) {
        if (below(upper) == kMaxBranches) verdict = violated("node", upper, "has more than two arcs below");
        if (above(lower) == kMaxBranches) verdict = violated("node", lower, "has more than two arcs above");
        degree[upper] = static_cast<std::uint8_t>(degree[upper] + 4);
        degree[lower] = static_cast<std::uint8_t>(degree[lower] + 1);
    }
};

/// Removes leaves; what is left when none is left is a cycle. Every node but the last must have an arc. leaves: degrees.
template <class Number>
Verdict has_no_cycle(const ContourTree<Number>& tree, const Degrees<Number>& leaves) {
    using Element = ElementIdOf<Number>;
    ByElement<Number, std::uint8_t> arcs(leaves.degree.size());
    const Element outside = tree.outside();
    for (const Element x : arcs.ids()) arcs[x] = static_cast<std::uint8_t>(leaves.above(x) + leaves.below(x));
    for_chains<Element>(
        outside.index(), at_random(), [&](Element x) { return x != outside && arcs[x] == 1; },
        [&](Element x) {
            arcs[x] = 0;
            --arcs[tree.other[x]];
            return tree.other[x];
        });
    for (const Element x : IdRange<Element>(outside.index())) {
        if (arcs[x] != 0) return violated("node", x, "lies on a cycle of arcs");
    }
    return {};
}

}  // namespace

template <class I>
Verdict children_come_before_parents(IdSpan<I, const I> parent) {
    if (parent.empty()) return Verdict("there is no root");
    const I root(parent.size() - 1);
    for (const I x : streamed<I>(root.index(), in_order(8))) {
        if (parent[x] <= x || parent[x] > root) return violated("node", x, "has the impossible parent " + text(parent[x]));
    }
    return parent[root] == root ? Verdict() : violated("node", root, "is the last one but not a root");
}

template <class Number>
Verdict is_join_tree(MergeTreeView<Number> parent) {
    if (Verdict order = children_come_before_parents(parent); !order) return order;
    const ByElement<Number, std::uint8_t> children = children_of<Number>(parent);
    const int of_outside = children.items().back();
    if (parent.size() > 1 && of_outside != 1) return Verdict("the outside has " + text(of_outside) + " children");
    return at_most_two_children(children);
}

template <class Number>
Verdict is_split_tree(MergeTreeView<Number> parent) {
    using Element = ElementIdOf<Number>;
    if (parent.empty() || parent[Element(0)] != Element(0)) return Verdict("node 0 is not a root");
    for (const Element x : streamed<Element>(parent.size(), in_order(8))) {
        if (x != Element(0) && parent[x] >= x) return violated("node", x, "has the impossible parent " + text(parent[x]));
    }
    return at_most_two_children(children_of<Number>(parent));  // nothing comes after the outside: it has none
}

template <class Number>
Verdict is_contour_tree(const ContourTree<Number>& tree) {
    if (tree.nodes() == 0 || tree.degree.size() != tree.nodes()) return Verdict("the arrays of the tree have different sizes");
    Degrees<Number> counted(tree);
    if (!counted.verdict) return counted.verdict;
    const ElementIdOf<Number> outside = tree.outside();
    for (const auto x : tree.other.ids()) {
        if (tree.has_arc(x) != (x != outside)) return violated("node", x, x == outside ? "is the outside and has an arc" : "has no arc");
        if (tree.degree[x] != counted.degree[x]) return violated("node", x, "has another number of arcs than its degree");
    }
    if (tree.nodes() > 1 && counted.above(outside) != 1) return Verdict(text(counted.above(outside)) + " arcs run to the outside");
    return has_no_cycle(tree, counted);
}

template <class Number>
Verdict every_arc_has_one_contour(const ContourTree<Number>& tree, MergeTreeView<Number> join, MergeTreeView<Number> split) {
    using Element = ElementIdOf<Number>;
    const std::size_t nodes = tree.nodes();
    if (join.size() != nodes || split.size() != nodes) return Verdict("the trees have different sizes");
    if (Verdict verdict = is_join_tree<Number>(join); !verdict) return verdict;
    if (Verdict verdict = is_split_tree<Number>(split); !verdict) return verdict;
    const Degrees<Number> arcs(tree);
    if (!arcs.verdict) return arcs.verdict;
    const ByElement<Number, std::uint8_t> arriving = children_of<Number>(join), leaving = children_of<Number>(split);
    std::int64_t contours = 0, objects = 0, lows = 1;
    for (const Element x : streamed<Element>(tree.outside().index(), in_order(8))) {  // the cut just below x
        contours += arcs.below(x) - arcs.above(x);
        objects += 1 - arriving[x];
        lows += leaving[x] - 1;
        if (contours != objects + lows - 1) {
            return violated("below node", x,
                            "there are " + text(contours) + " arcs, " + text(objects) + " objects and " + text(lows) + " low components");
        }
    }
    return {};
}

template <class Number>
Verdict euler_numbers_add_up(const ContourTree<Number>& tree, ByElementView<Number, std::int8_t> delta_chi) {
    using Element = ElementIdOf<Number>;
    using Signed = typename ContourTree<Number>::Signed;
    const std::size_t n = delta_chi.size();
    if (tree.nodes() != n + 1 || tree.half_chi.size() != n + 1) return Verdict("the arrays of the tree have different sizes");
    const Element outside = tree.outside();
    ByElement<Number, Signed> change(filled(n + 1, Signed{0}));  // sum below - sum above
    for (const Element x : streamed<Element>(n + 1, at_random(2))) {
        if (tree.other[x] > outside) return violated("node", x, "has an arc to no node");
        if (!tree.has_arc(x)) continue;
        change[tree.upper(x)] += tree.half_chi[x];
        change[tree.lower(x)] -= tree.half_chi[x];
    }
    for (const Element x : change.ids()) {
        const int expected = x != outside ? delta_chi[x] : -1;
        if (change[x] != expected) {
            return violated("node", x, "changes the Euler number by " + text(change[x]) + ", not by " + text(expected));
        }
    }
    return {};
}

template <class Number>
Verdict every_level_has_one_value(const ContourTree<Number>& tree, ByElementView<Number, ElementIdOf<Number>> level,
                                  ByElementView<Number, double> value) {
    using Element = ElementIdOf<Number>;
    const std::size_t n = value.size();
    if (level.size() != n || tree.nodes() != n + 1) return Verdict("the arrays of the tree have different sizes");
    std::size_t levels = 0, joined = 0;
    for (const Element x : streamed<Element>(n, at_random(2))) {
        if (level[x] > x || level[level[x]] != level[x]) return violated("element", x, "has the impossible level " + text(level[x]));
        if (value[level[x]] != value[x]) return violated("element", x, "has another value than its level");
        levels += level[x] == x;
        const Element other = tree.other[x];
        if (other >= tree.outside() || value[other] != value[x]) continue;
        ++joined;
        if (level[other] != level[x]) return violated("the arc of element", x, "has no length and joins two levels");
    }
    if (levels + joined != n) return Verdict(text(levels) + " levels of " + text(n) + " elements and " + text(joined) + " arcs inside");
    return {};
}

template <class Number>
Verdict every_event_has_its_zone(const CriticalityTree<Number>& tree, ByElementView<Number, double> value) {
    using Element = ElementIdOf<Number>;
    using Event = EventIdOf<Number>;
    const std::size_t events = tree.size(), n = value.size();
    if (tree.parent.size() != events || tree.event_of_element.size() != n) return Verdict("the arrays of the tree have different sizes");
    if (Verdict verdict = children_come_before_parents<Event>(tree.parent); !verdict) return verdict;
    const auto low_end = [&](Event e) {
        return tree.is_root(e) ? -std::numeric_limits<double>::infinity() : value[tree.top[tree.parent[e]]];
    };
    for (const Event e : streamed<Event>(events, at_random(2))) {
        if (tree.top[e].index() >= n || tree.event_of_element[tree.top[e]] != e)
            return violated("event", e, "has the highest element of another");
    }
    for (const Element i : streamed<Element>(n, at_random(3))) {
        const Event e = tree.event_of_element[i];
        if (e.index() >= events) return violated("element", i, "belongs to no event");
        if (!(low_end(e) < value[i] && value[i] <= value[tree.top[e]])) return violated("element", i, "lies outside the zone of its event");
    }
    return {};
}

// NOLINTBEGIN(bugprone-macro-parentheses): Number is a type
#define ISOATLAS_PREDICATES(Number)                                                                                               \
    template Verdict children_come_before_parents(IdSpan<ElementIdOf<Number>, const ElementIdOf<Number>>);                        \
    template Verdict children_come_before_parents(IdSpan<EventIdOf<Number>, const EventIdOf<Number>>);                            \
    template Verdict is_join_tree(MergeTreeView<Number>);                                                                         \
    template Verdict is_split_tree(MergeTreeView<Number>);                                                                        \
    template Verdict is_contour_tree(const ContourTree<Number>&);                                                                 \
    template Verdict every_arc_has_one_contour(const ContourTree<Number>&, MergeTreeView<Number>, MergeTreeView<Number>);         \
    template Verdict euler_numbers_add_up(const ContourTree<Number>&, ByElementView<Number, std::int8_t>);                        \
    template Verdict every_level_has_one_value(const ContourTree<Number>&, MergeTreeView<Number>, ByElementView<Number, double>); \
    template Verdict every_event_has_its_zone(const CriticalityTree<Number>&, ByElementView<Number, double>);
ISOATLAS_PREDICATES(std::uint32_t)
ISOATLAS_PREDICATES(std::uint64_t)
#undef ISOATLAS_PREDICATES
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace isoatlas
