// Reduction of a part: all arcs of the contour tree that a part of the elements decides on its own (docs/decisions).
//
// An extremum is open when it belongs to another part, or another part refers to it; so is the outside. A component of the sweep over the
// part alone is closed when it holds no open extremum: it meets elements of this part only, so it is a component of the sweep over all
// elements too, and the next element it meets is known. Leaves are removed as in contour_tree.h, open extrema never: so whatever has become
// a leaf has a closed component behind it. What is removed is final, whatever the other parts hold, because the order of removals does not
// matter (Carr, Snoeyink, Axen 2003).
//
// What is left is again a set of elements with representatives: the trees of the survivors of all parts give the other arcs.
//
// In the literature: the local tree of a block, reduced to what crosses its boundary (Carr, Ruebel, Weber, Distributed hierarchical contour
// trees, 2022).
#pragma once

#include <span>

#include "base/bit_ranks.h"
#include "critical/partitioned_set.h"

namespace isoatlas {

/// The extrema that other parts than their own refer to, by number.
struct OpenExtrema {
    BitRanks maxima, minima;
};
template <class Number>
[[nodiscard]] OpenExtrema open_extrema(const PartitionedSet<Number>& set, int threads);

/// Reduces one part: elements, which belong to the set or are a copy of what does. Branches of what is removed become kRemoved; arc, per
/// element of the part: the element (by its place in the part) at the other end of its arc towards the outside; arcs of survivors are left
/// alone. Branches and representatives of survivors become those that are left, each represented by a survivor that is a leaf; a leaf
/// represents itself. Cost: O(n alpha) time; 25 bytes an element and 24 an extremum while it runs, for 32-bit ids.
template <class Number>
void reduce_part(const PartitionedSet<Number>& set, std::size_t part, const OpenExtrema& open,
                 std::span<PartitionedElement<Number>> elements, std::span<ElementIdOf<Number>> arc);

}  // namespace isoatlas
