// Join and split tree: union-find over maxima (minima) in one sweep over the sorted critical elements; merge tree of the extremum graph
// (Lukasczyk et al. 2023; docs/theory/3-trees.md#join-and-split-tree).
//
// Join tree: sweep down; parent[p] = the first critical element below p that p's object meets. Split tree: sweep up, symmetric, where the
// outside (node `size`) is the lowest leaf. In the join tree the outside is the last node: the parent of the root.
//
// In the literature: merge tree, as join tree and split tree (Carr, Snoeyink, Axen, Computing contour trees in all dimensions, 2003); on
// critical points alone: Lukasczyk et al., ExTreeM, 2023.
#pragma once

#include "critical/critical_set.h"
#include "critical/partitioned_set.h"
#include "tree/contour_tree.h"

namespace isoatlas {

/// parent.size() == size + 1; parent[size] (the outside) is size itself: nothing lies below it. Cost: O(n alpha).
template <class Number>
MergeTree<Number> join_tree(const CriticalSet<Number>& critical);

/// parent.size() == size + 1; the highest element is its own parent.
template <class Number>
MergeTree<Number> split_tree(const CriticalSet<Number>& critical);

/// The same of the survivors of a reduction (tree/reduce.h), whose leaves need not be extrema of the field.
template <class Number>
MergeTree<Number> join_tree(const RepresentedSet<Number>& set);
template <class Number>
MergeTree<Number> split_tree(const RepresentedSet<Number>& set);

}  // namespace isoatlas
