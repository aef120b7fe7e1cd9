// analyse() in two steps, for callers that keep what the first one found.
#pragma once

#include "field/volume_view.h"
#include "isoatlas/analysis.h"

namespace isoatlas {

/// The trees. Zones are left out, whatever the options say.
[[nodiscard]] Analysis analyse_trees(const VolumeView& volume, const AnalysisOptions& options, const Context& context);

/// Counts the voxels of every zone. of_voxels: keeps the zone of every voxel too.
void add_zones(Analysis& analysis, const VolumeView& volume, bool of_voxels, const Context& context);

}  // namespace isoatlas
