// CandidateTable: the significant branches of one side, and the isovalues that show each best (docs/theory/7-which-objects-matter.md).
#pragma once

#include <vector>

#include "features/branch_decomposition.h"
#include "features/branch_histogram.h"
#include "features/noise.h"
#include "isoatlas/objects.h"

namespace isoatlas {

/// A branch and one isovalue on it. Values are heights (analysis/object_tree.h).
struct Candidate {
    BranchId branch;
    double appears, merges, tau, hypervolume;
    bool outline;                     ///< tau shows everything that is not background
    EventId event = EventId::none();  ///< its zone contains tau
    std::int64_t voxels = 0;
    double measure = 0;
};

/// An isovalue of a branch that has a row. tau: a height.
struct BranchIsovalue {
    BranchId branch;
    double tau, prominence;
    IsovalueReason reason;
    std::int64_t cavity = -1;  ///< as in RecommendedIsovalue
    double volume = 0;         ///< voxels of the object there, about
};

struct CandidateTable {
    std::vector<Candidate> rows;  ///< by rank; the main branch, which has several rows (main_branch_isovalues.h), first
    /// Of the branches that have rows, by rank; of each first those that have rows; then by descending prominence, outlines last.
    std::vector<BranchIsovalue> isovalues;
    std::vector<BranchHistogram> histograms;  ///< of these branches, by rank
};

/// Cost: three passes over the samples.
template <class Id>
[[nodiscard]] CandidateTable find_candidates(const VolumeView& volume, const ObjectTree<Id>& tree, const BranchDecomposition& branches,
                                             const NoiseModel& noise, const RankOptions& options);

/// Per row: position of the closest other row that contains it, -1: none. That is on the way down from its event the first of a lower tau.
template <class Id>
[[nodiscard]] std::vector<std::int64_t> closest_around(const ObjectTree<Id>& tree, const std::vector<Candidate>& rows);

}  // namespace isoatlas
