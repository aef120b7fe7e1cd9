#include "tree/predicates.h"

#include <limits>

#include "base/memory_limit.h"
#include "base/paced_fill.h"

namespace isoatlas {
namespace {

template <class Number>
std::string text(Number number) {
    return std::to_string(number);
}

Verdict violated(const char* what, std::size_t node, const std::string& how) { return Verdict(what + (" " + text(node)) + " " + how); }

constexpr std::uint8_t kMaxBranches = 2;  // above an element, and below

/// How many children every node has. The parents must be nodes.
template <class Id>
BigVector<std::uint8_t> children_of(std::span<const Id> parent) {
    BigVector<std::uint8_t> count = filled<std::uint8_t>(parent.size(), std::uint8_t{0});
    BudgetPoll memory;
    for (std::size_t x = 0; x < parent.size(); ++x) {
        memory.step(BudgetPoll::kTouch);
        if (std::uint8_t& of = count[parent[x]]; parent[x] != static_cast<Id>(x) && of <= kMaxBranches) ++of;
    }
    return count;
}

template <class Id>
Verdict at_most_two_children(std::span<const std::uint8_t> children) {
    for (std::size_t x = 0; x < children.size(); ++x) {
        if (children[x] > kMaxBranches) return violated("node", x, "has more than two children");
    }
    return {};
}

/// Degrees of a contour tree counted from its arcs, as in ContourTree::degree.
struct Degrees {
    BigVector<std::uint8_t> degree;
    Verdict verdict;

    template <class Id>
    explicit Degrees(const ContourTree<Id>& tree) : degree(filled<std::uint8_t>(tree.nodes(), std::uint8_t{0})) {
        BudgetPoll memory;
        for (std::size_t x = 0; x < tree.nodes() && verdict; ++x) {
            memory.step(BudgetPoll::kTouch);
            if (tree.other[x] >= tree.nodes()) verdict = violated("node", x, "has an arc to no node");
            if (!verdict || !tree.has_arc(x)) continue;
            const std::size_t upper = tree.upper(x), lower = tree.lower(x);
            if (below(upper) == kMaxBranches) verdict = violated("node", upper, "has more than two arcs below");
            if (above(lower) == kMaxBranches) verdict = violated("node", lower, "has more than two arcs above");
            degree[upper] = static_cast<std::uint8_t>(degree[upper] + 4);
            degree[lower] = static_cast<std::uint8_t>(degree[lower] + 1);
        }
    }
    [[nodiscard]] int above(std::size_t x) const { return degree[x] & 3; }
    [[nodiscard]] int below(std::size_t x) const { return degree[x] >> 2; }
};

/// Removes leaves; what is left when none is left is a cycle. Every node but the last must have an arc. leaves: degrees, consumed.
template <class Id>
Verdict has_no_cycle(const ContourTree<Id>& tree, Degrees leaves) {
    BigVector<std::uint8_t>& arcs = leaves.degree;
    const std::size_t outside = tree.nodes() - 1;
    for (std::size_t x = 0; x <= outside; ++x) arcs[x] = static_cast<std::uint8_t>(leaves.above(x) + leaves.below(x));
    BudgetPoll memory;
    for (std::size_t seed = 0; seed < outside; ++seed) {
        for (std::size_t x = seed; x != outside && arcs[x] == 1; x = tree.other[x]) {
            memory.step(BudgetPoll::kTouch);
            arcs[x] = 0;
            --arcs[tree.other[x]];
        }
    }
    for (std::size_t x = 0; x < outside; ++x) {
        if (arcs[x] != 0) return violated("node", x, "lies on a cycle of arcs");
    }
    return {};
}

}  // namespace

template <class Id>
Verdict children_come_before_parents(std::span<const Id> parent) {
    if (parent.empty()) return Verdict("there is no root");
    const std::size_t root = parent.size() - 1;
    BudgetPoll memory;
    for (std::size_t x = 0; x < root; ++x) {
        memory.step();
        if (parent[x] <= x || parent[x] > root) return violated("node", x, "has the impossible parent " + text(parent[x]));
    }
    return parent[root] == root ? Verdict() : violated("node", root, "is the last one but not a root");
}

template <class Id>
Verdict is_join_tree(std::span<const Id> parent) {
    if (Verdict order = children_come_before_parents(parent); !order) return order;
    const BigVector<std::uint8_t> children = children_of(parent);
    if (parent.size() > 1 && children.back() != 1) return Verdict("the outside has " + text(int{children.back()}) + " children");
    return at_most_two_children<Id>(children);
}

template <class Id>
Verdict is_split_tree(std::span<const Id> parent) {
    if (parent.empty() || parent[0] != 0) return Verdict("node 0 is not a root");
    BudgetPoll memory;
    for (std::size_t x = 1; x < parent.size(); ++x) {
        memory.step();
        if (parent[x] >= x) return violated("node", x, "has the impossible parent " + text(parent[x]));
    }
    return at_most_two_children<Id>(children_of(parent));  // nothing comes after the outside: it has none
}

template <class Id>
Verdict is_contour_tree(const ContourTree<Id>& tree) {
    if (tree.nodes() == 0 || tree.degree.size() != tree.nodes()) return Verdict("the arrays of the tree have different sizes");
    Degrees counted(tree);
    if (!counted.verdict) return counted.verdict;
    const std::size_t outside = tree.nodes() - 1;
    for (std::size_t x = 0; x <= outside; ++x) {
        if (tree.has_arc(x) != (x != outside)) return violated("node", x, x == outside ? "is the outside and has an arc" : "has no arc");
        if (tree.degree[x] != counted.degree[x]) return violated("node", x, "has another number of arcs than its degree");
    }
    if (outside > 0 && counted.above(outside) != 1) return Verdict(text(counted.above(outside)) + " arcs run to the outside");
    return has_no_cycle(tree, std::move(counted));
}

template <class Id>
Verdict every_arc_has_one_contour(const ContourTree<Id>& tree, std::span<const Id> join, std::span<const Id> split) {
    const std::size_t nodes = tree.nodes();
    if (join.size() != nodes || split.size() != nodes) return Verdict("the trees have different sizes");
    if (Verdict verdict = is_join_tree(join); !verdict) return verdict;
    if (Verdict verdict = is_split_tree(split); !verdict) return verdict;
    const Degrees arcs(tree);
    if (!arcs.verdict) return arcs.verdict;
    const BigVector<std::uint8_t> arriving = children_of(join), leaving = children_of(split);
    std::int64_t contours = 0, objects = 0, lows = 1;
    BudgetPoll memory;
    for (std::size_t x = 0; x + 1 < nodes; ++x) {  // the cut just below x
        memory.step();
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

template <class Id>
Verdict euler_numbers_add_up(const ContourTree<Id>& tree, std::span<const std::int8_t> delta_chi) {
    using Signed = typename ContourTree<Id>::Signed;
    const std::size_t n = delta_chi.size();
    if (tree.nodes() != n + 1 || tree.half_chi.size() != n + 1) return Verdict("the arrays of the tree have different sizes");
    BigVector<Signed> change = filled(n + 1, Signed{0});  // sum below - sum above
    BudgetPoll memory;
    for (std::size_t x = 0; x <= n; ++x) {
        memory.step(2 * BudgetPoll::kTouch);
        if (tree.other[x] > n) return violated("node", x, "has an arc to no node");
        if (!tree.has_arc(x)) continue;
        change[tree.upper(x)] += tree.half_chi[x];
        change[tree.lower(x)] -= tree.half_chi[x];
    }
    for (std::size_t x = 0; x <= n; ++x) {
        const int expected = x < n ? delta_chi[x] : -1;
        if (change[x] != expected) {
            return violated("node", x, "changes the Euler number by " + text(change[x]) + ", not by " + text(expected));
        }
    }
    return {};
}

template <class Id>
Verdict every_level_has_one_value(const ContourTree<Id>& tree, std::span<const Id> level, std::span<const double> value) {
    const std::size_t n = value.size();
    if (level.size() != n || tree.nodes() != n + 1) return Verdict("the arrays of the tree have different sizes");
    std::size_t levels = 0, joined = 0;
    BudgetPoll memory;
    for (std::size_t x = 0; x < n; ++x) {
        memory.step(2 * BudgetPoll::kTouch);
        if (level[x] > x || level[level[x]] != level[x]) return violated("element", x, "has the impossible level " + text(level[x]));
        if (value[level[x]] != value[x]) return violated("element", x, "has another value than its level");
        levels += level[x] == x;
        const std::size_t other = tree.other[x];
        if (other >= n || value[other] != value[x]) continue;
        ++joined;
        if (level[other] != level[x]) return violated("the arc of element", x, "has no length and joins two levels");
    }
    if (levels + joined != n) return Verdict(text(levels) + " levels of " + text(n) + " elements and " + text(joined) + " arcs inside");
    return {};
}

template <class Id>
Verdict every_event_has_its_zone(const CriticalityTree<Id>& tree, std::span<const double> value) {
    const std::size_t events = tree.size(), n = value.size();
    if (tree.parent.size() != events || tree.event_of_element.size() != n) return Verdict("the arrays of the tree have different sizes");
    if (Verdict verdict = children_come_before_parents<Id>(tree.parent); !verdict) return verdict;
    const auto low_end = [&](std::size_t e) {
        return tree.is_root(e) ? -std::numeric_limits<double>::infinity() : value[tree.top[tree.parent[e]]];
    };
    BudgetPoll memory;
    for (std::size_t e = 0; e < events; ++e) {
        memory.step(2 * BudgetPoll::kTouch);
        if (tree.top[e] >= n || tree.event_of_element[tree.top[e]] != e) return violated("event", e, "has the highest element of another");
    }
    for (std::size_t i = 0; i < n; ++i) {
        memory.step(3 * BudgetPoll::kTouch);
        const std::size_t e = tree.event_of_element[i];
        if (e >= events) return violated("element", i, "belongs to no event");
        if (!(low_end(e) < value[i] && value[i] <= value[tree.top[e]])) return violated("element", i, "lies outside the zone of its event");
    }
    return {};
}

#define ISOATLAS_PREDICATES(Id)                                                                                       \
    template Verdict children_come_before_parents(std::span<const Id>);                                               \
    template Verdict is_join_tree(std::span<const Id>);                                                               \
    template Verdict is_split_tree(std::span<const Id>);                                                              \
    template Verdict is_contour_tree(const ContourTree<Id>&);                                                         \
    template Verdict every_arc_has_one_contour(const ContourTree<Id>&, std::span<const Id>, std::span<const Id>);     \
    template Verdict euler_numbers_add_up(const ContourTree<Id>&, std::span<const std::int8_t>);                      \
    template Verdict every_level_has_one_value(const ContourTree<Id>&, std::span<const Id>, std::span<const double>); \
    template Verdict every_event_has_its_zone(const CriticalityTree<Id>&, std::span<const double>);
ISOATLAS_PREDICATES(std::uint32_t)
ISOATLAS_PREDICATES(std::uint64_t)
#undef ISOATLAS_PREDICATES

}  // namespace isoatlas
