// rank_objects(), rank_cavities() and rank_both() for samples that lie anywhere.
#pragma once

#include "isoatlas/cavities.h"
#include "isoatlas/objects.h"

namespace isoatlas {

struct VolumeView;
struct ZoneSums;

/// Cost: beside each other the sublevel tree with its branches (features/cavity_candidates.h) and those of the superlevel tree, each some
/// passes over samples and zones in order, one voxel after the other; 60 bytes an event of both trees.
[[nodiscard]] ObjectTable rank_objects(const VolumeView& volume, const Analysis& analysis, const RankOptions& options,
                                       const Context& context);

[[nodiscard]] CavityTable rank_cavities(const VolumeView& volume, const Analysis& analysis, const RankOptions& options,
                                        const Context& context);

/// sums: receives those of sum_zones(), unless null.
[[nodiscard]] ObjectsAndCavities rank_both(const VolumeView& volume, const Analysis& analysis, const RankOptions& options,
                                           const Context& context, ZoneSums* sums = nullptr);

}  // namespace isoatlas
