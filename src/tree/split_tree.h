// The split tree restored from the contour tree alone (Carr, Snoeyink, Axen 2003: the contour tree has the split tree of its volume), with
// the representative of every low component.
//
// In the literature: split tree, the merge tree of sublevel sets.
#pragma once

#include "tree/contour_tree.h"

namespace isoatlas {

/// Per node of the contour tree (the outside is the last).
template <class Number>
struct SplitTree {
    MergeTree<Number> parent;                       ///< the first element above at which the low component changes; the highest is its own
    ByElement<Number, ElementIdOf<Number>> lowest;  ///< lowest node of the low component just above this node
};

/// Cost: O(n alpha) time, 12 bytes a node while it runs, for 32-bit ids.
template <class Number>
[[nodiscard]] SplitTree<Number> split_tree_of(const ContourTree<Number>& contours);

}  // namespace isoatlas
