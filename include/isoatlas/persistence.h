// Persistence pairs of objects: at which isovalue each appears, and at which it is lost in one that is older.
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

}  // namespace isoatlas
