// Branch decomposition of a merge tree by hypervolume (docs/theory/7-which-objects-matter.md#branches-by-hypervolume).
//
// Hypervolume of the object of event e at its low end tau: sum over its voxels of (height - tau). Where objects merge, the branch of the
// largest hypervolume continues; the others end there. (By height instead, as in the elder rule, a large body becomes the branch of a small
// bright peak.)
//
// The notation of this folder (docs/theory/7-which-objects-matter.md#notation):
//   height           value of a sample for superlevel sets, value negated for sublevel sets (analysis/object_tree.h)
//   branch           a path of events from a maximum of height (top) down to the height at which it ends (bottom: its last event)
//   appears, merges  heights of its two ends, between which it is an object of its own
//   main branch      the branch that never ends; the first of every list by rank
//   rank             position by descending hypervolume
//   V(tau), q        voxels of the object of a branch at tau; q = -d ln V / d tau (features/stable_isovalue.h)
//   stable           an isovalue of locally least q; outline, outer, inner, merge, middle: the other reasons (isoatlas/objects.h)
//   gate             drops what noise explains (features/select_branches.h); significant: a branch that passes it
//   row, candidate   a branch and one isovalue on it (features/candidates.h)
//   cavity           a low component of the sublevel side; wall: the contour around it (features/cavity_walls.h)
//
// In the literature: branch decomposition (Pascucci, Cole-McLaughlin, Scorzelli 2004) by hypervolume (Carr, Snoeyink, van de Panne,
// Simplifying flexible isosurfaces using local geometric measures, 2004).
#pragma once

#include <cstdint>

#include "features/zone_sums.h"

namespace isoatlas {

struct VolumeView;
template <class Id>
struct ObjectTree;

/// Values are heights (analysis/object_tree.h).
struct Branch {
    EventId top, bottom;     ///< its highest event (a maximum) and its lowest
    EventId highest;         ///< event of the highest element in the object at the low end (may lie in another branch)
    BranchId parent;         ///< the branch that it ends in; none: the main branch
    double appears, merges;  ///< height of top; height at which it ends, -infinity for the main branch
    double hypervolume;      ///< of the object just above merges (the main branch: above the lowest sample)
    double persistence;      ///< highest height of that object - merges
    std::int64_t voxels;     ///< of that object
};

/// Over the object of each event at its low end.
struct ObjectSums {
    IdArray<EventId, std::int64_t> voxels;
    IdArray<EventId, double> sum;  ///< of heights
};

inline constexpr BranchId kMainBranch(0);

struct BranchDecomposition {
    IdArray<BranchId, Branch> branch;     ///< by descending hypervolume, ties: higher top first; the first is the main branch
    IdArray<EventId, BranchId> of_event;  ///< the branch of each event
    IdArray<EventId, EventId> highest;    ///< event of the highest element of its object
    ObjectSums objects;
    double lowest = 0;  ///< height of the lowest sample
};

/// Cost: one pass over the samples, in order, so that sums do not depend on threads.
template <class Id>
[[nodiscard]] ZoneSums sum_zones(const ObjectTree<Id>& tree, const VolumeView& volume);

/// tree.zone may be empty. Cost: O(events log events).
template <class Id>
[[nodiscard]] BranchDecomposition decompose_branches(const ObjectTree<Id>& tree, const ZoneSums& zones);

}  // namespace isoatlas
