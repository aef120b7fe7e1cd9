// The criticality tree: events and their objects (docs/theory/3-trees.md#events).
//
// Event = join-tree nodes of one value joined by arcs of no length, contracted: all that happens to one object at one value. Events without
// a non-trivial level are dropped; they have exactly one child, whose zone continues below them. Events are numbered in descending order of
// their highest element, so children have smaller numbers than their parent; the root is the last.
//
// In the literature: the augmented merge tree (join tree) of superlevel sets (Carr, Snoeyink, Axen, Computing contour trees in all
// dimensions, 2003).
#pragma once

#include "isoatlas/criticality.h"
#include "tree/levels.h"

namespace isoatlas {

template <class Number>
struct CriticalityTree {
    using Element = ElementIdOf<Number>;
    using Event = EventIdOf<Number>;
    ByElement<Number, Event> event_of_element;  ///< for an element of a dropped event the next one above
    ByEvent<Number, Element> top;               ///< its highest element
    ByEvent<Number, Event> parent;              ///< the event itself for the root

    [[nodiscard]] std::size_t size() const { return top.size(); }
    [[nodiscard]] Event root() const { return Event(size() - 1); }
    [[nodiscard]] bool is_root(SameKind<Event> auto e) const { return parent[e].index() == e.index(); }
};

/// What an event does and what its object is in the zone below it; all per event.
template <class Number>
struct EventMeasures {
    using Signed = std::make_signed_t<Number>;
    ByEvent<Number, Number> lows_out;
    ByEvent<Number, Number> contours;  ///< of the object
    ByEvent<Number, Signed> delta_chi;
    ByEvent<Number, Signed> chi;        ///< of the object
    ByEvent<Number, Criticality> kind;  ///< that of its non-trivial levels when they agree, else complex
};

/// Per element: the lowest element of its group of equal-valued join nodes. join: parents of the join tree, n + 1 entries. Cost: O(n).
template <class Number>
ByElement<Number, ElementIdOf<Number>> join_groups(MergeTreeView<Number> join, ByElementView<Number, double> value);

/// group: of join_groups. level, kind: of levels.h. Cost: O(n).
template <class Number>
CriticalityTree<Number> criticality_tree(ByElement<Number, ElementIdOf<Number>> group, MergeTreeView<Number> join,
                                         ByElementView<Number, ElementIdOf<Number>> level, ByElementView<Number, LevelKind> kind,
                                         int threads = 1);

/// Cost: O(n).
template <class Number>
EventMeasures<Number> measure_events(const CriticalityTree<Number>& tree, const ContourTree<Number>& contours,
                                     ByElementView<Number, ElementIdOf<Number>> level, ByElementView<Number, LevelKind> kind,
                                     ByElementView<Number, std::int8_t> delta_chi, int threads = 1);

}  // namespace isoatlas
