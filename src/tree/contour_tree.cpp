#include "tree/contour_tree.h"

#include <utility>

#include "base/check.h"
#include "base/paced_fill.h"
#include "base/parallel.h"
#include "base/streamed.h"

namespace isoatlas {
namespace {

constexpr std::size_t kNodesAhead = 16;  // a parent is fetched so many nodes before it is needed

// A node in both trees while leaves are removed: its parents, and the xor of its children (the child itself once only one is left).
// Side by side, because a removal touches all four and the next node is somewhere else.
template <class Number>
struct Links {
    ElementIdOf<Number> join_parent;
    Number join_children;
    ElementIdOf<Number> split_parent;
    Number split_children;
};

/// Nodes of one of the two trees. Parent, Children: its members of Links.
template <class Number, ElementIdOf<Number> Links<Number>::* Parent, Number Links<Number>::* Children>
struct ShrinkingTree {
    using Element = ElementIdOf<Number>;
    IdSpan<Element, Links<Number>> node;

    [[nodiscard]] bool is_root(Element x) const { return node[x].*Parent == x; }
    [[nodiscard]] Element parent(Element x) const { return node[x].*Parent; }

    /// Fills in the children. Returns how many each node has.
    [[nodiscard]] ByElement<Number, std::uint8_t> gather_children() {
        ByElement<Number, std::uint8_t> count(filled(node.size(), std::uint8_t{0}));
        for (const Element x : streamed<Element>(node.size(), at_random())) {
            if (x.index() + kNodesAhead < node.size()) __builtin_prefetch(&node[parent(Element(x.index() + kNodesAhead))], 1);
            if (is_root(x)) continue;
            node[parent(x)].*Children ^= x.number();
            ++count[parent(x)];
        }
        return count;
    }
    void remove_leaf(Element x) { node[parent(x)].*Children ^= x.number(); }
    /// x has exactly one child: it takes the place of x.
    void splice(Element x) {
        const Element child(node[x].*Children);
        if (is_root(x)) {
            node[child].*Parent = child;
        } else {
            node[child].*Parent = parent(x);
            node[parent(x)].*Children ^= x.number() ^ child.number();
        }
    }
};

template <class Number>
using ShrinkingJoinTree = ShrinkingTree<Number, &Links<Number>::join_parent, &Links<Number>::join_children>;
template <class Number>
using ShrinkingSplitTree = ShrinkingTree<Number, &Links<Number>::split_parent, &Links<Number>::split_children>;

/// Removes x from both trees: a leaf of one, a node with one child in the other. Returns the other end of its arc.
template <class Element, class LeafTree, class OtherTree>
Element remove(Element x, LeafTree& leaf_tree, OtherTree& other_tree) {
    leaf_tree.remove_leaf(x);
    other_tree.splice(x);
    return leaf_tree.parent(x);
}

constexpr std::uint8_t kUpperLeaf = 0 | 1 << 2;  // nothing above, one below (ContourTree::degree)
constexpr std::uint8_t kLowerLeaf = 1 | 0 << 2;
constexpr std::uint8_t kGone = 0xff;

/// half_chi until the arc of a node is made: sum(above) + delta_chi - sum(below) over the arcs made at the node.
template <class Number>
auto start_half_chi(std::size_t nodes, ByElementView<Number, std::int8_t> delta_chi) {
    using Signed = typename ContourTree<Number>::Signed;
    ByElement<Number, Signed> half_chi(filled(nodes, Signed{0}));
    if (delta_chi.empty()) return half_chi;
    for (const auto x : delta_chi.ids()) half_chi[x] = delta_chi[x];
    half_chi.items().back() = -1;  // the outside closes every contour like a minimum
    return half_chi;
}

}  // namespace

template <class Number>
ContourTree<Number> contour_tree(MergeTreeView<Number> join_parents, MergeTree<Number> split_parents,
                                 ByElementView<Number, std::int8_t> delta_chi, int threads) {
    using Element = ElementIdOf<Number>;
    using Signed = typename ContourTree<Number>::Signed;
    const std::size_t nodes = join_parents.size();
    ByElement<Number, Links<Number>> links(nodes);
    for_each_index(threads, nodes, [&](std::size_t i) {
        const Element x(i);
        links[x] = {join_parents[x], 0, split_parents[x], 0};
    });
    release(split_parents.items());
    ShrinkingJoinTree<Number> join{links};
    ShrinkingSplitTree<Number> split{links};
    ByElement<Number, std::uint8_t> count, below;
    run_both(threads, [&] { count = join.gather_children(); }, [&] { below = split.gather_children(); });
    for (const Element x : count.ids()) count[x] = static_cast<std::uint8_t>(count[x] | below[x] << 2);
    ContourTree<Number> tree;
    tree.degree = count;
    tree.other.items().resize(nodes);
    tree.half_chi = start_half_chi(nodes, delta_chi);

    std::size_t arcs = 0;
    const Element outside = tree.outside();
    // Follow the chain of leaves that a seed uncovers; earlier seeds that become leaves are taken by the chain itself.
    for_chains<Element>(
        outside.index(), at_random(4), [&](Element x) { return x != outside && (count[x] == kUpperLeaf || count[x] == kLowerLeaf); },
        [&](Element x) {
            const bool upper = count[x] == kUpperLeaf;
            const Element y = upper ? remove(x, join, split) : remove(x, split, join);
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
            return y;
        });
    ISOATLAS_CHECK(arcs == outside.index());
    tree.other[outside] = outside;
    ISOATLAS_CHECK(tree.half_chi[outside] == 0);
    return tree;
}

#define ISOATLAS_CONTOUR_TREE(Number) \
    template ContourTree<Number> contour_tree(MergeTreeView<Number>, MergeTree<Number>, ByElementView<Number, std::int8_t>, int);
ISOATLAS_CONTOUR_TREE(std::uint32_t)
ISOATLAS_CONTOUR_TREE(std::uint64_t)
#undef ISOATLAS_CONTOUR_TREE

}  // namespace isoatlas
