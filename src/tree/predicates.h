// Predicates of trees: what holds for the trees of any volume. Shared by unit tests, the theorems, `isoatlas verify` and the checks of
// debug builds (ISOATLAS_DCHECK). They share no code with what makes the trees. Each costs O(n) and at most one number a node while it
// runs.
//
// In the literature: join, split and contour tree as in Carr, Snoeyink, Axen, Computing contour trees in all dimensions, 2003.
#pragma once

#include <string>
#include <utility>

#include "tree/contour_tree.h"
#include "tree/criticality_tree.h"

namespace isoatlas {

/// What a predicate found: true, or the first violation.
class [[nodiscard]] Verdict {
public:
    Verdict() = default;
    explicit Verdict(std::string violation) : violation_(std::move(violation)) {}
    explicit operator bool() const { return violation_.empty(); }
    [[nodiscard]] const std::string& violation() const { return violation_; }

private:
    std::string violation_;
};

/// Every node but the last has a parent with a larger number; the last one, the root, is its own parent: one root, no cycle.
template <class I>
Verdict children_come_before_parents(IdSpan<I, const I> parent);

/// Of merge_tree.h: children come before parents, no node has more than two, and the outside, the last node, has one.
template <class Number>
Verdict is_join_tree(MergeTreeView<Number> parent);

/// Of merge_tree.h: parents come before children, node 0 is its own parent, no node has more than two children, the outside none.
template <class Number>
Verdict is_split_tree(MergeTreeView<Number> parent);

/// n arcs between n + 1 nodes without a cycle, one of them at the outside and that above it; `degree` counts them, at most two above a node
/// and two below.
template <class Number>
Verdict is_contour_tree(const ContourTree<Number>& tree);

/// At every cut of the total order the arcs that cross it are as many as objects (from the join tree) and low components (from the split
/// tree), less one: one for each contour (docs/theory/1-elements-and-order.md#objects-low-components-contours, T1). join, split: as made by
/// merge_tree.h.
template <class Number>
Verdict every_arc_has_one_contour(const ContourTree<Number>& tree, MergeTreeView<Number> join, MergeTreeView<Number> split);

/// At every element: sum of half_chi below = sum above + delta_chi; the arc at the outside is a sphere (docs/theory/4-genus.md#t4). 3D.
template <class Number>
Verdict euler_numbers_add_up(const ContourTree<Number>& tree, ByElementView<Number, std::int8_t> delta_chi);

/// level: of level_roots(). Levels are what arcs of no length join, no more and no less; the highest element of each stands for it.
template <class Number>
Verdict every_level_has_one_value(const ContourTree<Number>& tree, ByElementView<Number, ElementIdOf<Number>> level,
                                  ByElementView<Number, double> value);

/// Children come before parents, and the value of every element, that of the highest one included, lies in the zone of its event:
/// (value(parent), value(event)], which is not empty.
template <class Number>
Verdict every_event_has_its_zone(const CriticalityTree<Number>& tree, ByElementView<Number, double> value);

}  // namespace isoatlas
