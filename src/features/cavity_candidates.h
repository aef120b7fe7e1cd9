// CavityCandidates: the sublevel tree, its branches, and the significant ones.
// In the literature: components of sublevel sets; cavities or voids where an object encloses them.
#pragma once

#include "analysis/sublevel_tree.h"
#include "features/candidates.h"

namespace isoatlas {

struct CavityTable;

template <class Id>
struct CavityCandidates {
    SublevelTree<Id> sublevel;
    ObjectTree<Id> tree;
    BranchDecomposition branches;
    CandidateTable chosen;  ///< without the outside; one row a branch

    /// Lowest voxel of the low component of an event; -1: the outside.
    [[nodiscard]] std::int64_t voxel(const AnalysisArrays<Id>& arrays, EventId event) const {
        return lowest_voxel(arrays, sublevel, branches.highest[event]);
    }
};

/// All that options keep, whatever options.top. Cost: as make_sublevel_tree(), and four passes over the samples.
template <class Id>
[[nodiscard]] CavityCandidates<Id> make_cavity_candidates(const VolumeView& volume, const AnalysisArrays<Id>& arrays,
                                                          const NoiseModel& noise, const RankOptions& options, const Context& context);

/// The table of given candidates. Cost: up to top queries at isovalues (isoatlas/active.h).
template <class Id>
[[nodiscard]] CavityTable cavity_table(const VolumeView& volume, const Analysis& analysis, const AnalysisArrays<Id>& arrays,
                                       const CavityCandidates<Id>& side, const NoiseModel& noise, std::int64_t top);

}  // namespace isoatlas
