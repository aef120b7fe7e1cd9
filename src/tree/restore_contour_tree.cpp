// Restores the data of a contour tree from its arcs alone.
#include "tree/contour_tree.h"

#include "base/memory_limit.h"
#include "base/paced_fill.h"

namespace isoatlas {
namespace {

constexpr std::uint8_t kMaxArcs = 2;  // above, and below

/// Counts arcs above and below. Returns false when an id is out of range, an element has too many arcs, or the outside not just one.
template <class Id>
bool count_arcs(ContourTree<Id>& tree) {
    const std::size_t nodes = tree.nodes();
    fill_fresh(tree.degree, nodes, std::uint8_t{0});
    BudgetPoll memory;
    for (std::size_t x = 0; x < nodes; ++x) {
        memory.step(BudgetPoll::kTouch);
        if (tree.other[x] >= nodes) return false;
        if (!tree.has_arc(x)) continue;
        std::uint8_t& below_upper = tree.degree[tree.upper(x)];
        std::uint8_t& above_lower = tree.degree[tree.lower(x)];
        if (below_upper >> 2 == kMaxArcs || (above_lower & 3) == kMaxArcs) return false;
        below_upper = static_cast<std::uint8_t>(below_upper + 4);
        above_lower = static_cast<std::uint8_t>(above_lower + 1);
    }
    return !tree.has_arc(nodes - 1) && (nodes == 1 || tree.above(nodes - 1) == 1);
}

}  // namespace

// At every node: sum of half_chi below = sum above + delta_chi. Nodes are finished from the leaves to the outside.
template <class Id>
bool complete_contour_tree(ContourTree<Id>& tree, std::span<const std::int8_t> delta_chi) {
    using Signed = typename ContourTree<Id>::Signed;
    const std::size_t nodes = tree.nodes();
    if (nodes == 0 || !count_arcs(tree)) return false;
    fill_fresh(tree.half_chi, nodes, Signed{0});
    if (!delta_chi.empty()) {
        for (std::size_t x = 0; x + 1 < nodes; ++x) tree.half_chi[x] = delta_chi[x];
        tree.half_chi[nodes - 1] = -1;
    }
    BigVector<std::uint8_t> waits_for(nodes);  // arcs that are not finished, its own included
    for (std::size_t x = 0; x < nodes; ++x) waits_for[x] = static_cast<std::uint8_t>(tree.above(x) + tree.below(x));
    std::size_t finished = 0;
    BudgetPoll memory;
    for (std::size_t seed = 0; seed + 1 < nodes; ++seed) {
        memory.step();
        for (std::size_t x = seed; x + 1 < nodes && waits_for[x] == 1;) {
            memory.step(3 * BudgetPoll::kTouch);
            const std::size_t y = tree.other[x];
            if (y == x) return false;
            if (y < x) tree.half_chi[x] = static_cast<Signed>(-tree.half_chi[x]);
            tree.half_chi[y] += y > x ? tree.half_chi[x] : static_cast<Signed>(-tree.half_chi[x]);
            waits_for[x] = 0;
            --waits_for[y];
            ++finished;
            x = y;
        }
    }
    return finished + 1 == nodes && tree.half_chi[nodes - 1] == 0;
}

// The root of a component is its lowest node so far: the join tree with shortcuts.
template <class Id>
BigVector<Id> join_tree_of(const ContourTree<Id>& tree) {
    const std::size_t nodes = tree.nodes();
    BigVector<std::array<Id, kMaxArcs>> above(nodes);
    for (std::size_t x = 0; x < nodes; ++x) above[x] = {static_cast<Id>(x), static_cast<Id>(x)};
    BudgetPoll memory;
    for (std::size_t x = 0; x < nodes; ++x) {
        if (!tree.has_arc(x)) continue;
        memory.step(BudgetPoll::kTouch);
        std::array<Id, kMaxArcs>& neighbours = above[tree.lower(x)];
        neighbours[neighbours[0] == tree.lower(x) ? 0 : 1] = tree.upper(x);
    }
    BigVector<Id> parent(nodes), root(nodes);
    for (std::size_t x = 0; x < nodes; ++x) {
        memory.step(4 * BudgetPoll::kTouch);
        parent[x] = root[x] = static_cast<Id>(x);
        for (Id r : above[x]) {
            while (root[r] != r) {
                root[r] = root[root[r]];
                r = root[r];
            }
            parent[r] = root[r] = static_cast<Id>(x);
        }
    }
    return parent;
}

#define ISOATLAS_RESTORE(Id)                                                             \
    template bool complete_contour_tree(ContourTree<Id>&, std::span<const std::int8_t>); \
    template BigVector<Id> join_tree_of(const ContourTree<Id>&);
ISOATLAS_RESTORE(std::uint32_t)
ISOATLAS_RESTORE(std::uint64_t)
#undef ISOATLAS_RESTORE

}  // namespace isoatlas
