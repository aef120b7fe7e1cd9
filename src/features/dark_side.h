// Dark objects in the making: the dark tree, its branches, and those that matter.
// In the literature: components of sublevel sets; cavities or voids where an object encloses them.
#pragma once

#include "analysis/dark_tree.h"
#include "features/branch_rows.h"

namespace isoatlas {

template <class Id>
struct DarkSide {
    DarkTree<Id> dark;
    SideTree<Id> tree;
    Branches branches;
    BranchRows chosen;  ///< without the outside; one row a branch

    /// Lowest voxel of the dark object of an event; -1: the outside.
    [[nodiscard]] std::int64_t voxel(const AnalysisArrays<Id>& arrays, std::int64_t event) const {
        return lowest_voxel(arrays, dark, static_cast<std::size_t>(branches.highest[event]));
    }
};

/// All that options keep, whatever options.top. Cost: as make_dark_tree(), and four passes over the samples.
template <class Id>
[[nodiscard]] DarkSide<Id> make_dark_side(const VolumeView& volume, const AnalysisArrays<Id>& arrays, const NoiseModel& noise,
                                          const RankOptions& options, const Context& context);

}  // namespace isoatlas
