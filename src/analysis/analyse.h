// The parts of an analysis that a store keeps, computed in separate steps; all else is restored from them (analysis/trees.h).
#pragma once

#include "field/volume_view.h"
#include "isoatlas/analysis.h"

namespace isoatlas {

/// Critical elements and the arcs of the contour tree, nothing else: accessors of the result must not be called. Works while memory is
/// limited (base/memory_limit.h).
[[nodiscard]] Analysis find_arcs(const VolumeView& volume, const AnalysisOptions& options, const Context& context);

/// Counts the voxels of every critical element: needs value, code and arcs. May keep the basins for complete().
void count_voxels(Analysis& analysis, const VolumeView& volume, const Context& context);

/// Finds the zone of every voxel by the trees. Returns false when the trees are not of these samples: a damaged store. Throws
/// Error{cancelled}. Cost: the links and basins of all voxels; random access to what is proportional to the critical elements.
[[nodiscard]] bool add_zones(Analysis& analysis, const VolumeView& volume, const Context& context);

/// Makes a whole analysis of value, code and arcs: the trees, and the zone of every voxel. Cost: restore_trees() and add_zones().
void complete(Analysis& analysis, const VolumeView& volume, const Context& context);

}  // namespace isoatlas
