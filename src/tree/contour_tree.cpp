#include "tree/contour_tree.h"

#include <utility>

#include "base/check.h"
#include "base/memory_limit.h"
#include "base/paced_fill.h"
#include "base/parallel.h"

namespace isoatlas {
namespace {

constexpr std::size_t kAhead = 16;  // a parent is fetched so many nodes before it is needed

// A node in both trees while leaves are removed: its parents, and the xor of its children (the child itself once only one is left).
// Side by side, because a removal touches all four and the next node is somewhere else.
template <class Id>
struct Links {
    Id join_parent, join_children, split_parent, split_children;
};

/// Nodes of one of the two trees. Parent, Children: its members of Links.
template <class Id, Id Links<Id>::* Parent, Id Links<Id>::* Children>
struct ShrinkingTree {
    std::span<Links<Id>> node;

    [[nodiscard]] bool is_root(std::size_t x) const { return node[x].*Parent == static_cast<Id>(x); }
    [[nodiscard]] Id parent(std::size_t x) const { return node[x].*Parent; }

    /// Fills in the children. Returns how many each node has.
    [[nodiscard]] BigVector<std::uint8_t> gather_children() {
        BigVector<std::uint8_t> count = filled<std::uint8_t>(node.size(), std::uint8_t{0});
        BudgetPoll memory;
        for (std::size_t x = 0; x < node.size(); ++x) {
            memory.step(BudgetPoll::kTouch);
            if (x + kAhead < node.size()) __builtin_prefetch(&node[parent(x + kAhead)], 1);
            if (is_root(x)) continue;
            node[parent(x)].*Children ^= static_cast<Id>(x);
            ++count[parent(x)];
        }
        return count;
    }
    void remove_leaf(std::size_t x) { node[parent(x)].*Children ^= static_cast<Id>(x); }
    /// x has exactly one child: it takes the place of x.
    void splice(std::size_t x) {
        const Id child = node[x].*Children;
        if (is_root(x)) {
            node[child].*Parent = child;
        } else {
            node[child].*Parent = parent(x);
            node[parent(x)].*Children ^= static_cast<Id>(x) ^ child;
        }
    }
};

template <class Id>
using ShrinkingJoinTree = ShrinkingTree<Id, &Links<Id>::join_parent, &Links<Id>::join_children>;
template <class Id>
using ShrinkingSplitTree = ShrinkingTree<Id, &Links<Id>::split_parent, &Links<Id>::split_children>;

/// Removes x from both trees: a leaf of one, a node with one child in the other. Returns the other end of its arc.
template <class Id, class LeafTree, class OtherTree>
Id remove(std::size_t x, LeafTree& leaf_tree, OtherTree& other_tree) {
    leaf_tree.remove_leaf(x);
    other_tree.splice(x);
    return leaf_tree.parent(x);
}

constexpr std::uint8_t kUpperLeaf = 0 | 1 << 2;  // nothing above, one below (ContourTree::degree)
constexpr std::uint8_t kLowerLeaf = 1 | 0 << 2;
constexpr std::uint8_t kGone = 0xff;

}  // namespace

template <class Id>
ContourTree<Id> contour_tree(std::span<const Id> join_parents, BigVector<Id> split_parents, std::span<const std::int8_t> delta_chi,
                             int threads) {
    using Signed = typename ContourTree<Id>::Signed;
    const std::size_t nodes = join_parents.size();
    BigVector<Links<Id>> links(nodes);
    for_each_index(threads, nodes, [&](std::size_t x) { links[x] = {join_parents[x], 0, split_parents[x], 0}; });
    release(split_parents);
    ShrinkingJoinTree<Id> join{links};
    ShrinkingSplitTree<Id> split{links};
    BigVector<std::uint8_t> count, below;
    run_both(threads, [&] { count = join.gather_children(); }, [&] { below = split.gather_children(); });
    for (std::size_t x = 0; x < nodes; ++x) count[x] = static_cast<std::uint8_t>(count[x] | below[x] << 2);
    ContourTree<Id> tree;
    tree.degree = count;
    tree.other.resize(nodes);
    fill_fresh(tree.half_chi, nodes,
               Signed{0});  // until its arc is made: sum(above) + delta_chi - sum(below) over the arcs made at the node
    if (!delta_chi.empty()) {
        for (std::size_t x = 0; x + 1 < nodes; ++x) tree.half_chi[x] = delta_chi[x];
        tree.half_chi[nodes - 1] = -1;  // the outside closes every contour like a minimum
    }

    std::size_t arcs = 0;
    BudgetPoll memory;
    const std::size_t outside = nodes - 1;
    for (std::size_t seed = 0; seed < outside; ++seed) {
        // Follow the chain of leaves that this one uncovers; earlier seeds that become leaves are taken by the chain itself.
        for (std::size_t x = seed; x != outside && (count[x] == kUpperLeaf || count[x] == kLowerLeaf);) {
            memory.step(4 * BudgetPoll::kTouch);
            const bool upper = count[x] == kUpperLeaf;
            const Id y = upper ? remove<Id>(x, join, split) : remove<Id>(x, split, join);
            tree.other[x] = y;
            if (upper) {
                tree.half_chi[y] += tree.half_chi[x];
                count[y] = static_cast<std::uint8_t>(count[y] - 1);
            } else {
                tree.half_chi[x] = static_cast<Signed>(-tree.half_chi[x]);
                tree.half_chi[y] -= tree.half_chi[x];
                count[y] = static_cast<std::uint8_t>(count[y] - 4);
            }
            count[x] = kGone;
            ++arcs;
            x = y;
        }
    }
    ISOATLAS_CHECK(arcs == outside);
    tree.other[outside] = static_cast<Id>(outside);
    ISOATLAS_CHECK(tree.half_chi[outside] == 0);
    return tree;
}

template ContourTree<std::uint32_t> contour_tree(std::span<const std::uint32_t>, BigVector<std::uint32_t>, std::span<const std::int8_t>,
                                                 int);
template ContourTree<std::uint64_t> contour_tree(std::span<const std::uint64_t>, BigVector<std::uint64_t>, std::span<const std::int8_t>,
                                                 int);

}  // namespace isoatlas
