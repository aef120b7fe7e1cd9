// Isovalues of the two boundaries of a body with cavities (docs/theory/7-which-objects-matter.md#outer-and-inner-boundary).
//
// The volume V of a body shrinks at its outer boundary and at the walls of its cavities alike; where these are sharp at different
// isovalues, -d ln V / d tau is minimal at neither. So each is measured alone: the outer boundary through the body with its cavities
// filled, the wall of a cavity through the cavity. Only significant cavities count.
#pragma once

#include <vector>

#include "features/cavity_candidates.h"

namespace isoatlas {

/// Per row of candidates.chosen: the event of the object around it at the highest isovalue at which it is closed. Cost: a query at an
/// isovalue (isoatlas/active.h) for each.
template <class Id>
[[nodiscard]] std::vector<EventId> objects_around(const Analysis& analysis, const AnalysisArrays<Id>& arrays,
                                                  const CavityCandidates<Id>& candidates);

/// A branch of objects that a cavity branch lies in, for isovalues (cavity branch appears, closed].
struct Enclosure {
    BranchId branch;
    double closed;  ///< stored value
};

/// Per row of candidates.chosen: the branches of objects that it is a cavity of one after the other, as the isovalue falls. around: of
/// objects_around().
template <class Id>
[[nodiscard]] std::vector<std::vector<Enclosure>> enclosures(const ObjectTree<Id>& objects, const BranchDecomposition& branches,
                                                             const CavityCandidates<Id>& candidates, const std::vector<EventId>& around);

/// The histograms of branches of objects with their cavities filled: V(tau) counts the voxels of the object and those that lie in one of
/// these cavities at some isovalue up to tau, objects inside included. As cavities open they stay filled, so that their opening is no loss
/// of volume. Cost: one pass over the samples.
template <class Id>
[[nodiscard]] std::vector<BranchHistogram> fill_cavities(const VolumeView& volume, const ObjectTree<Id>& objects,
                                                         const BranchDecomposition& branches, std::vector<BranchHistogram> histograms,
                                                         const CavityCandidates<Id>& candidates,
                                                         const std::vector<std::vector<Enclosure>>& enclosures);

/// Further isovalues of the branches of chosen: reasons outer and inner, grouped by branch by rank; of each first the outer boundary by
/// descending prominence, then up to five cavities by rank, each at its best isovalue. Only what is stable, while the cavity is closed, and
/// distinguishable from the isovalues of the branch after smoothing. Cost: one pass over the samples.
template <class Id>
[[nodiscard]] std::vector<BranchIsovalue> wall_isovalues(const VolumeView& volume, const AnalysisArrays<Id>& arrays,
                                                         const ObjectTree<Id>& objects, const BranchDecomposition& branches,
                                                         const CandidateTable& chosen, const CavityCandidates<Id>& candidates,
                                                         const std::vector<EventId>& around);

}  // namespace isoatlas
