// Checks of an analysis against itself: what must hold for any volume, whatever its values. Each costs O(what it looks at). Of the arrays
// the predicates of tree/predicates.h, of the accessors that they say the same.
#pragma once

#include "isoatlas/analysis.h"
#include "isoatlas/verify.h"

namespace isoatlas {

/// Values fall towards the root, ids grow, parents and children agree, there is one root and it is the last event.
[[nodiscard]] CheckResult join_tree_is_valid(const Analysis& analysis);

/// Every voxel lies in one zone, its value inside the zone's interval, and the voxel counts of the zones are right.
[[nodiscard]] CheckResult zones_partition_voxels(const Analysis& analysis, const Volume& volume);

/// chi = 1 - b1 + b2 of every object; chi and voxels add up along the tree; the contours' genera add up to b1; at the root is a solid box.
[[nodiscard]] CheckResult euler_sums_hold(const Analysis& analysis);

/// Arcs run downwards between their elements, never close a cycle, and exactly one runs to the outside.
[[nodiscard]] CheckResult contour_tree_is_a_tree(const Analysis& analysis);

/// Levels are non-trivial, sorted, belong to an event of their value, every event has one, and they explain its change of Euler number.
[[nodiscard]] CheckResult levels_match_events(const Analysis& analysis);

}  // namespace isoatlas
