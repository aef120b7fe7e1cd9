#include "tree/contour_tree.h"

#include <utility>

#include "base/check.h"
#include "base/paced_fill.h"
#include "base/parallel.h"
#include "base/prefetch.h"
#include "base/streamed.h"

namespace isoatlas {
namespace {

constexpr std::size_t kNodesAhead = 16;  // a parent is fetched so many nodes before it is needed

// A node while leaves are removed. Side by side, because a removal touches all of it at a node that is somewhere else.
template <class Number>
struct ShrinkingNode {
    ElementIdOf<Number> join_parent, split_parent;  // a removed node is passed over (other_end)
    std::make_signed_t<Number> half_chi;            // until its arc is made: sum(above) + delta_chi - sum(below) over arcs made at the node
    std::uint8_t left;                              // of its degree (ContourTree::degree), or how it was removed
};

constexpr std::uint8_t kUpperLeaf = 0 | 1 << 2;  // nothing above, one below
constexpr std::uint8_t kLowerLeaf = 1 | 0 << 2;
constexpr std::uint8_t kUpperGone = 0xfe, kLowerGone = 0xff;  // was removed as an upper leaf, as a lower leaf

template <class Number, ElementIdOf<Number> ShrinkingNode<Number>::* Parent>
ElementIdOf<Number> other_end(IdSpan<ElementIdOf<Number>, ShrinkingNode<Number>> nodes, ElementIdOf<Number> leaf) {
    using Element = ElementIdOf<Number>;
    // A leaf of one tree had one child in the other, so it can be passed over there. Path halving.
    Element x = leaf, parent = nodes[x].*Parent;
    while (nodes[parent].left >= kUpperGone) {
        parent = nodes[parent].*Parent;
        nodes[x].*Parent = parent;
        if (nodes[parent].left < kUpperGone) break;
        x = parent;
        parent = nodes[x].*Parent;
    }
    return nodes[leaf].*Parent = parent;
}

/// How many children each node has.
template <class Number>
ByElement<Number, std::uint8_t> count_children(MergeTreeView<Number> parent) {
    using Element = ElementIdOf<Number>;
    ByElement<Number, std::uint8_t> count(filled(parent.size(), std::uint8_t{0}));
    for (const Element x : streamed<Element>(parent.size(), at_random())) {
        if (x.index() + kNodesAhead < parent.size()) prefetch_to_write(&count[parent[Element(x.index() + kNodesAhead)]]);
        if (parent[x] != x) ++count[parent[x]];
    }
    return count;
}

/// Nodes and degrees of the contour tree, all arcs to be made.
template <class Number>
ByElement<Number, ShrinkingNode<Number>> start_nodes(MergeTreeView<Number> join, MergeTreeView<Number> split,
                                                     ByElementView<Number, std::int8_t> delta_chi, int threads,
                                                     ByElement<Number, std::uint8_t>& degree) {
    using Element = ElementIdOf<Number>;
    const std::size_t count = join.size();
    ByElement<Number, std::uint8_t> below;
    run_both(threads, [&] { degree = count_children<Number>(join); }, [&] { below = count_children<Number>(split); });
    ByElement<Number, ShrinkingNode<Number>> nodes(count);
    for_each_index(threads, count, [&](std::size_t i) {
        const Element x(i);
        degree[x] = static_cast<std::uint8_t>(degree[x] | below[x] << 2);
        const bool has_chi = i < delta_chi.size();
        nodes[x] = {join[x], split[x], has_chi ? delta_chi[x] : std::int8_t{0}, degree[x]};
    });
    if (!delta_chi.empty()) nodes[Element(count - 1)].half_chi = -1;  // the outside closes every contour like a minimum
    return nodes;
}

/// Removes leaves until only the outside is left; then the arc of a node is in it. Returns how many were removed.
template <class Number>
std::size_t remove_leaves(IdSpan<ElementIdOf<Number>, ShrinkingNode<Number>> nodes) {
    using Element = ElementIdOf<Number>;
    using Node = ShrinkingNode<Number>;
    using Signed = std::make_signed_t<Number>;
    const Element outside(nodes.size() - 1);
    const auto is_leaf = [&](const Node& node) { return node.left == kUpperLeaf || node.left == kLowerLeaf; };
    std::size_t arcs = 0;
    // Follow the chain of leaves that a seed uncovers; earlier seeds that become leaves are taken by the chain itself.
    for_chains<Element>(
        outside.index(), at_random(4), [&](Element x) { return x != outside && is_leaf(nodes[x]); },
        [&](Element x) {
            Node& node = nodes[x];
            const bool upper = node.left == kUpperLeaf;
            const Element y = upper ? other_end<Number, &Node::join_parent>(nodes, x) : other_end<Number, &Node::split_parent>(nodes, x);
            Node& end = nodes[y];
            if (!upper) node.half_chi = static_cast<Signed>(-node.half_chi);
            end.half_chi += upper ? node.half_chi : static_cast<Signed>(-node.half_chi);
            end.left = static_cast<std::uint8_t>(end.left - (upper ? kLowerLeaf : kUpperLeaf));
            node.left = upper ? kUpperGone : kLowerGone;
            ++arcs;
            return y;
        },
        [&](std::size_t seed) {
            if (seed + kNodesAhead >= nodes.size()) return;
            const Node& node = nodes[Element(seed + kNodesAhead)];
            if (is_leaf(node)) prefetch_to_write(&nodes[node.left == kUpperLeaf ? node.join_parent : node.split_parent]);
        });
    return arcs;
}

}  // namespace

template <class Number>
ContourTree<Number> contour_tree(MergeTreeView<Number> join_parents, MergeTree<Number> split_parents,
                                 ByElementView<Number, std::int8_t> delta_chi, int threads) {
    using Element = ElementIdOf<Number>;
    ContourTree<Number> tree;
    ByElement<Number, ShrinkingNode<Number>> nodes = start_nodes<Number>(join_parents, split_parents, delta_chi, threads, tree.degree);
    release(split_parents.items());
    const Element outside(nodes.size() - 1);
    ISOATLAS_CHECK(remove_leaves<Number>(nodes) == outside.index());
    ISOATLAS_CHECK(nodes[outside].half_chi == 0);
    nodes[outside].join_parent = outside;
    nodes[outside].left = kUpperGone;
    tree.other.items().resize(nodes.size());
    tree.half_chi.items().resize(nodes.size());
    for_each_index(threads, nodes.size(), [&](std::size_t i) {
        const ShrinkingNode<Number>& node = nodes[Element(i)];
        tree.other[Element(i)] = node.left == kUpperGone ? node.join_parent : node.split_parent;
        tree.half_chi[Element(i)] = node.half_chi;
    });
    return tree;
}

#define ISOATLAS_CONTOUR_TREE(Number) \
    template ContourTree<Number> contour_tree(MergeTreeView<Number>, MergeTree<Number>, ByElementView<Number, std::int8_t>, int);
ISOATLAS_CONTOUR_TREE(std::uint32_t)
ISOATLAS_CONTOUR_TREE(std::uint64_t)
#undef ISOATLAS_CONTOUR_TREE

}  // namespace isoatlas
