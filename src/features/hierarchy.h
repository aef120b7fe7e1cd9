// The data of a BranchHierarchy, and restoring one from a store.
// In the literature: branch decomposition (Pascucci, Cole-McLaughlin, Scorzelli, Multi-resolution computation and presentation of contour
// trees, 2004).
#pragma once

#include <span>
#include <vector>

#include "features/branch_decomposition.h"
#include "isoatlas/simplify.h"

namespace isoatlas {

struct BranchHierarchy::Data {
    BigVector<std::int64_t> parent;  ///< per event: of the criticality tree
    BigVector<double> value;         ///< per event
    BigVector<std::int64_t> voxels;  ///< per event, of its zone
    BranchDecomposition branches;
    std::vector<BranchInfo> info;
    BigVector<double> measure;  ///< per branch
    std::vector<std::int64_t> significant;

    [[nodiscard]] bool is_root(std::int64_t e) const { return parent[e] == e; }
};

/// Of a grid with uniform steps. analysis: with voxel counts. tops: of the significant branches, ascending. Cost: O(events log events).
[[nodiscard]] BranchHierarchy hierarchy_of(const VolumeInfo& info, const Analysis& analysis, const ZoneSums& zones,
                                           std::span<const std::int64_t> tops);

}  // namespace isoatlas
