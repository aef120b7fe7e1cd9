// Runs: neighbouring elements that lie one below the other on the same contour, contracted. Most of what survives a reduction (reduce.h)
// are long runs on few contours; the contour tree of the runs is so much smaller that it may be accessed at random.
//
// In the literature: superarcs, chains of nodes of degree two.
#pragma once

#include "critical/partitioned_set.h"
#include "tree/contour_tree.h"

namespace isoatlas {

/// ContourTree::other of a set, from its join and split tree (merge_tree.h), which are consumed.
/// Elements i and i + 1 are in one run when either has one branch above and one below, i + 1 is the parent of i in the join tree, and i
/// that of i + 1 in the split tree: then they are the ends of an arc. Cost: O(n); at random: 26 bytes a run for 32-bit ids.
template <class Number>
[[nodiscard]] ByElement<Number, ElementIdOf<Number>> arcs_by_runs(ByElementView<Number, std::uint8_t> branches, MergeTree<Number> join,
                                                                  MergeTree<Number> split, int threads);

}  // namespace isoatlas
