// The criticality tree: events and their objects (theory.md section 6c).
//
// Event = join-tree nodes of one value joined by arcs of no length, contracted: all that happens to one object at one value. Events without
// a non-trivial level are dropped; they have exactly one child, whose zone goes on below them. Events are numbered in descending order of
// their highest element, so children have smaller numbers than their parent; the root is the last.
#pragma once

#include <span>
#include <vector>

#include "tree/levels.h"

namespace isoatlas {

template <class Id>
struct CriticalityTree {
    using Signed = std::make_signed_t<Id>;
    std::vector<Id> event_of_element;   ///< per element: its event; for a dropped one the next event above

    // Indexed by event:
    std::vector<Id> top;                ///< its highest element
    std::vector<Id> parent;             ///< the event itself for the root
    std::vector<Id> lows_out;
    std::vector<Id> contours;           ///< of the object in the zone below the event
    std::vector<Signed> delta_chi;
    std::vector<Signed> chi;            ///< of the object in the zone below the event
    std::vector<Criticality> kind;

    [[nodiscard]] std::size_t size() const { return top.size(); }
    [[nodiscard]] bool is_root(std::size_t e) const { return parent[e] == static_cast<Id>(e); }
};

/// join: parents of the join tree, n + 1 entries. Cost: O(n).
template <class Id>
CriticalityTree<Id> criticality_tree(std::span<const Id> join, const Levels<Id>& levels, std::span<const double> value,
                                     std::span<const std::int8_t> delta_chi);

}  // namespace isoatlas
