// Contour tree and the genus of every contour (docs/theory/4-genus.md#t4).
//
// Merge of join and split tree by leaf removal (Carr, Snoeyink, Axen 2003). Nodes are the critical elements 0..n-1 in descending order and
// the outside n, which is never removed. Each removed node leaves exactly one arc, so arcs are indexed by the node whose removal made them,
// and the tree is rooted at the outside. half_chi of an arc = half the Euler number of its contour = 1 - genus (3D). At every node:
// sum(below) = sum(above) + delta_chi, so the same removal order that finds the arcs finds their Euler numbers.
//
// In the literature: contour tree, the Reeb graph of a function on a box (Carr, Snoeyink, Axen 2003), with Betti numbers (Pascucci,
// Cole-McLaughlin, Parallel computation of the topology of level sets, 2003).
#pragma once

#include <cstdint>
#include <type_traits>

#include "critical/ids.h"

namespace isoatlas {

template <class Number>
struct ContourTree {
    using Element = ElementIdOf<Number>;
    using Signed = std::make_signed_t<Number>;
    ByElement<Number, Element> other;        ///< the other end of the arc of a node, towards the outside; the outside has none: itself
    ByElement<Number, Signed> half_chi;      ///< of the arc of a node
    ByElement<Number, std::uint8_t> degree;  ///< how many arcs a node has above (low two bits) and below

    [[nodiscard]] int above(SameKind<Element> auto x) const { return degree[x] & 3; }
    [[nodiscard]] int below(SameKind<Element> auto x) const { return degree[x] >> 2; }

    [[nodiscard]] std::size_t nodes() const { return other.size(); }
    [[nodiscard]] Element outside() const { return Element(nodes() - 1); }
    [[nodiscard]] bool has_arc(Element x) const { return other[x] != x; }
    /// Upper and lower end: ids ascend downwards.
    [[nodiscard]] Element upper(Element x) const { return other[x] < x ? other[x] : x; }
    [[nodiscard]] Element lower(Element x) const { return other[x] < x ? x : other[x]; }
};

/// join, split: parents as made by merge_tree.h, n + 1 entries; split is consumed. delta_chi(x) for x < n;
/// empty: no Euler numbers (2D), half_chi is 0.
/// A node has as many arcs above as children in the join tree, and as many below as in the split tree.
/// Cost: O(n log n) time at worst, by path halving, and about one node at random an arc; 17 bytes a node beyond input and output for 32-bit
/// ids.
template <class Number>
ContourTree<Number> contour_tree(MergeTreeView<Number> join, MergeTree<Number> split, ByElementView<Number, std::int8_t> delta_chi,
                                 int threads = 1);

/// Fills in degree and half_chi of a tree that has `other` only. Returns false when it is not a tree rooted at the last node, a node has
/// more arcs than an element can have, or not exactly one arc runs to the outside. Cost: O(n).
template <class Number>
[[nodiscard]] bool complete_contour_tree(ContourTree<Number>& tree, ByElementView<Number, std::int8_t> delta_chi);

/// The join tree of the scalar field is that of its contour tree. Cost: O(n alpha); 12 bytes a node while it runs.
template <class Number>
[[nodiscard]] MergeTree<Number> join_tree_of(const ContourTree<Number>& tree);

}  // namespace isoatlas
