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
    IdArray<EventId, EventId> parent;  ///< of the criticality tree
    IdArray<EventId, double> value;
    IdArray<EventId, std::int64_t> voxels;  ///< of its zone
    BranchDecomposition branches;
    std::vector<BranchInfo> info;
    IdArray<BranchId, double> measure;
    std::vector<BranchId> significant;

    [[nodiscard]] bool is_root(EventId e) const { return parent[e] == e; }
};

/// Of a grid with uniform steps. analysis: with voxel counts. tops: of the significant branches, ascending. Cost: O(events log events).
[[nodiscard]] BranchHierarchy hierarchy_of(const VolumeInfo& info, const Analysis& analysis, const ZoneSums& zones,
                                           std::span<const EventId> tops);

}  // namespace isoatlas
