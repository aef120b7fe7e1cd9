// Restores the data of a contour tree from its arcs alone.
#include "tree/contour_tree.h"

#include <array>

#include "base/paced_fill.h"
#include "base/streamed.h"

namespace isoatlas {
namespace {

constexpr std::uint8_t kMaxArcs = 2;  // above, and below

/// Counts arcs above and below. Returns false when an id is out of range, an element has too many arcs, or the outside not just one.
template <class Number>
bool count_arcs(ContourTree<Number>& tree) {
    using Element = ElementIdOf<Number>;
    const std::size_t nodes = tree.nodes();
    fill_fresh(tree.degree.items(), nodes, std::uint8_t{0});
    for (const Element x : streamed<Element>(nodes, at_random())) {
        if (tree.other[x].index() >= nodes) return false;
        if (!tree.has_arc(x)) continue;
        std::uint8_t& below_upper = tree.degree[tree.upper(x)];
        std::uint8_t& above_lower = tree.degree[tree.lower(x)];
        if (below_upper >> 2 == kMaxArcs || (above_lower & 3) == kMaxArcs) return false;
        below_upper = static_cast<std::uint8_t>(below_upper + 4);
        above_lower = static_cast<std::uint8_t>(above_lower + 1);
    }
    return !tree.has_arc(tree.outside()) && (nodes == 1 || tree.above(tree.outside()) == 1);
}

}  // namespace

// At every node: sum of half_chi below = sum above + delta_chi. Nodes are finished from the leaves to the outside.
template <class Number>
bool complete_contour_tree(ContourTree<Number>& tree, ByElementView<Number, std::int8_t> delta_chi) {
    using Element = ElementIdOf<Number>;
    using Signed = typename ContourTree<Number>::Signed;
    const std::size_t nodes = tree.nodes();
    if (nodes == 0 || !count_arcs(tree)) return false;
    const Element outside = tree.outside();
    fill_fresh(tree.half_chi.items(), nodes, Signed{0});
    if (!delta_chi.empty()) {
        for (const Element x : delta_chi.ids()) tree.half_chi[x] = delta_chi[x];
        tree.half_chi[outside] = -1;
    }
    ByElement<Number, std::uint8_t> waits_for(nodes);  // arcs that are not finished, its own included
    for (const Element x : waits_for.ids()) waits_for[x] = static_cast<std::uint8_t>(tree.above(x) + tree.below(x));
    std::size_t finished = 0;
    for_chains<Element>(
        outside.index(), at_random(3), [&](Element x) { return x != outside && waits_for[x] == 1; },
        [&](Element x) {
            const Element y = tree.other[x];
            waits_for[x] = 0;
            if (y == x) return x;  // no arc: never finished
            if (y < x) tree.half_chi[x] = static_cast<Signed>(-tree.half_chi[x]);
            tree.half_chi[y] += y > x ? tree.half_chi[x] : static_cast<Signed>(-tree.half_chi[x]);
            --waits_for[y];
            ++finished;
            return y;
        });
    return finished + 1 == nodes && tree.half_chi[outside] == 0;
}

// The root of a component is its lowest node so far: the join tree with shortcuts.
template <class Number>
MergeTree<Number> join_tree_of(const ContourTree<Number>& tree) {
    using Element = ElementIdOf<Number>;
    const std::size_t nodes = tree.nodes();
    ByElement<Number, std::array<Element, kMaxArcs>> above(nodes);
    for (const Element x : above.ids()) above[x] = {x, x};
    for (const Element x : streamed<Element>(nodes, at_random())) {
        if (!tree.has_arc(x)) continue;
        std::array<Element, kMaxArcs>& neighbours = above[tree.lower(x)];
        neighbours[neighbours[0] == tree.lower(x) ? 0 : 1] = tree.upper(x);
    }
    MergeTree<Number> parent(nodes), root(nodes);
    for (const Element x : streamed<Element>(nodes, at_random(4))) {
        parent[x] = root[x] = x;
        for (Element r : above[x]) {
            while (root[r] != r) {
                root[r] = root[root[r]];
                r = root[r];
            }
            parent[r] = root[r] = x;
        }
    }
    return parent;
}

#define ISOATLAS_RESTORE(Number)                                                                   \
    template bool complete_contour_tree(ContourTree<Number>&, ByElementView<Number, std::int8_t>); \
    template MergeTree<Number> join_tree_of(const ContourTree<Number>&);
ISOATLAS_RESTORE(std::uint32_t)
ISOATLAS_RESTORE(std::uint64_t)
#undef ISOATLAS_RESTORE

}  // namespace isoatlas
