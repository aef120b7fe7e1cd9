// Selection of branches: by sizes, or by what noise explains (docs/theory/7-which-objects-matter.md#the-noise-gate).
// In the literature: topological simplification by persistence (Edelsbrunner, Letscher, Zomorodian 2002) and by geometric measures (Carr,
// Snoeyink, van de Panne 2004).
#pragma once

#include <vector>

#include "features/branch_decomposition.h"
#include "features/noise.h"
#include "isoatlas/selection.h"

namespace isoatlas {

/// Physical volume of the object of every branch just before it merges. Cost: O(branches); on rectilinear grids, where tree.zone is needed,
/// one pass over the voxels.
template <class Id>
[[nodiscard]] IdArray<BranchId, double> branch_measures(const ObjectTree<Id>& tree, const BranchDecomposition& branches,
                                                        const VolumeInfo& info);

/// By rank, the main branch first. measure: of branch_measures(); empty when the selection does not use it. Cost: O(branches).
[[nodiscard]] std::vector<BranchId> select_branches(const BranchDecomposition& branches, IdSpan<BranchId, const double> measure,
                                                    const Selection& selection);

/// How many voxels a shape needs to be significant, in a volume of so many.
[[nodiscard]] std::int64_t min_voxels(std::int64_t voxels);

/// Branches that noise does not explain and that are not tiny compared with the largest; the main branch first. The noise is that
/// around the value where they merge. voxels: of the volume; sign: of ObjectTree. Cost: O(branches that are large enough).
[[nodiscard]] std::vector<BranchId> significant_branches(const BranchDecomposition& branches, std::int64_t voxels, const NoiseModel& noise,
                                                         double sign);

}  // namespace isoatlas
