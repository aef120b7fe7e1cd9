// rank_objects() for samples that lie anywhere.
#pragma once

#include "field/volume_view.h"
#include "isoatlas/objects.h"

namespace isoatlas {

/// Cost: three passes over samples and zones in order, one voxel after the other; 60 bytes an event.
[[nodiscard]] ObjectTable rank_objects(const VolumeView& volume, const Analysis& analysis, const RankOptions& options);

}  // namespace isoatlas
