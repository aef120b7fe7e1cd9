// The dissertation's own algorithm (section 10.1), as a readable second opinion: a max-heap floods the volume from its critical elements;
// labels are repaired lazily by following parents when an element leaves the heap.
//
// Changes: neighbours are those of the graph G (grid edges, face points;
// docs/theory/1-elements-and-order.md#objects-low-components-contours), the critical elements are those of the octahedral rule (the
// dissertation's 26-neighbour test is wrong, docs/theory/2-critical-elements.md#the-larger-neighbourhood-is-wrong), ties follow the total
// order. Covers the join tree (maxima, merges, and where every other critical element hangs) and the label of every element; not the low
// side, not genus.
#pragma once

#include <span>
#include <vector>

#include "oracle/oracle.h"

namespace oracle {

struct Flooding {
    std::vector<Index>
        parent;                ///< of each critical element (position in the list given): next node of the same object going down; -1: root
    std::vector<Index> label;  ///< of each element: the node whose zone it lies in
};

/// critical: elements in descending order. Cost: O(n log n) heap steps plus the climbs.
Flooding flood(const Elements& elements, std::span<const CriticalElement> critical);

}  // namespace oracle
