// Persistence pairs of objects and of cavities: at which isovalue each appears, and at which it is lost. Stored values; tau falls.
//
// The pairs of tunnels are those of isoatlas/handles.h. Branches (isoatlas/simplify.h) part objects by hypervolume instead: where two
// merge, the larger one goes on, here the one that appeared first.
#pragma once

#include <vector>

#include "isoatlas/analysis.h"

namespace isoatlas {

/// An object for tau in (dies, born]. Stored values.
struct ObjectPair {
    double born, dies;       ///< dies = -infinity: the one that never merges
    EventId maximum, merge;  ///< events; merge: none where it never merges
    [[nodiscard]] double persistence() const { return born - dies; }
};

/// The pairs of the zeroth persistent homology of the superlevel sets (elder rule): where objects merge, that with the highest maximum
/// goes on, of equal ones that whose event has the smallest id. One for each maximum, in ascending order of its event, so that the one
/// that never merges comes first; none has persistence 0. Cost: O(events).
/// Source: Edelsbrunner, Letscher, Zomorodian, Topological persistence and simplification, 2002.
[[nodiscard]] std::vector<ObjectPair> pair_objects(const Analysis& analysis);

/// A cavity for tau in (dies, born]; 2D: a hole.
struct CavityPair {
    double born, dies;        ///< dies: its lowest value, where it is filled
    ElementId closes, fills;  ///< critical elements: it is cut off from an older low component, or from the outside; its minimum
    [[nodiscard]] double persistence() const { return born - dies; }
};

/// The pairs of the second persistent homology of the superlevel sets (2D: the first), by Alexander duality: those of the low components,
/// where the outside of the volume is the oldest one. In ascending order of `closes`, then `fills`: born descends; none has persistence 0.
/// Cost: O(n alpha) for n critical elements, 12 bytes each while it runs.
/// Source: Edelsbrunner, Kerber, Alexander duality for functions: the persistent behavior of land and water and shore, 2012.
[[nodiscard]] std::vector<CavityPair> pair_cavities(const Analysis& analysis);

}  // namespace isoatlas
