// The criticality tree: events and their objects (docs/theory/3-trees.md#events).
//
// Event = join-tree nodes of one value joined by arcs of no length, contracted: all that happens to one object at one value. Events without
// a non-trivial level are dropped; they have exactly one child, whose zone continues below them. Events are numbered in descending order of
// their highest element, so children have smaller numbers than their parent; the root is the last.
//
// In the literature: the augmented merge tree (join tree) of superlevel sets (Carr, Snoeyink, Axen, Computing contour trees in all
// dimensions, 2003).
#pragma once

#include <span>

#include "base/big_vector.h"
#include "isoatlas/criticality.h"
#include "tree/levels.h"

namespace isoatlas {

template <class Id>
struct CriticalityTree {
    BigVector<Id> event_of_element;  ///< per element: its event; for a dropped one the next event above
    // per event
    BigVector<Id> top;     ///< its highest element
    BigVector<Id> parent;  ///< the event itself for the root

    [[nodiscard]] std::size_t size() const { return top.size(); }
    [[nodiscard]] bool is_root(std::size_t e) const { return parent[e] == static_cast<Id>(e); }
};

/// What an event does and what its object is in the zone below it; all per event.
template <class Id>
struct EventMeasures {
    using Signed = std::make_signed_t<Id>;
    BigVector<Id> lows_out;
    BigVector<Id> contours;  ///< of the object
    BigVector<Signed> delta_chi;
    BigVector<Signed> chi;        ///< of the object
    BigVector<Criticality> kind;  ///< that of its non-trivial levels when they agree, else complex
};

/// Per element: the lowest element of its group of equal-valued join nodes. join: parents of the join tree, n + 1 entries. Cost: O(n).
template <class Id>
BigVector<Id> join_groups(std::span<const Id> join, std::span<const double> value);

/// group: of join_groups. level, kind: of levels.h. Cost: O(n).
template <class Id>
CriticalityTree<Id> criticality_tree(BigVector<Id> group, std::span<const Id> join, std::span<const Id> level,
                                     std::span<const LevelKind> kind);

/// delta_chi: per element. Cost: O(n).
template <class Id>
EventMeasures<Id> measure_events(const CriticalityTree<Id>& tree, const ContourTree<Id>& contours, std::span<const Id> level,
                                 std::span<const LevelKind> kind, std::span<const std::int8_t> delta_chi, int threads = 1);

}  // namespace isoatlas
