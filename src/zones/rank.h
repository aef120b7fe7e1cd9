// rank_objects() and rank_dark_objects() for samples that lie anywhere.
#pragma once

#include "field/volume_view.h"
#include "isoatlas/dark_objects.h"
#include "isoatlas/objects.h"

namespace isoatlas {

/// Cost: three passes over samples and zones in order, one voxel after the other; 60 bytes an event.
[[nodiscard]] ObjectTable rank_objects(const VolumeView& volume, const Analysis& analysis, const RankOptions& options);

[[nodiscard]] DarkTable rank_dark_objects(const VolumeView& volume, const Analysis& analysis, const RankOptions& options,
                                          const Context& context);

}  // namespace isoatlas
