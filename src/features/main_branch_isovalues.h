// Which isovalues of the main branch get a row of the table. It is several nested objects: skin and skull, block and inserts.
#pragma once

#include "features/candidates.h"

namespace isoatlas {

/// Isovalues just above those at which another significant branch joins the main branch: the last ones that show it without that branch.
/// Only where the other one is at least a twentieth of what they become, where the main branch has grown by a third since the next of its
/// isovalues, and where a standard deviation of the noise more takes at most a tenth of it away. significant: these branches, by rank;
/// histogram, own: of the main branch. Reason merge. Cost: O(significant + bins).
[[nodiscard]] std::vector<BranchIsovalue> before_merges(const BranchDecomposition& branches, const std::vector<BranchId>& significant,
                                                        const BranchHistogram& histogram, const std::vector<BranchIsovalue>& own,
                                                        const NoiseModel& noise);

/// Moves those that get a row to the front, from the outside in, what is hardly more than the box of the volume last; the others keep their
/// order. Returns how many. The last outline has a row; the others are taken by prominence, less where the object is about as large as at
/// one that is taken: then it looks the same. own: by descending prominence, outlines last; voxels: of the volume.
[[nodiscard]] std::size_t arrange_main_branch(std::vector<BranchIsovalue>& own, std::int64_t voxels);

}  // namespace isoatlas
