// What the other parts of this folder need of an Atlas.
#pragma once

#include "bricks/stored_samples.h"
#include "census/level_census.h"
#include "isoatlas/atlas.h"

namespace isoatlas {

struct AtlasAccess {
    /// Read when it is first asked for.
    [[nodiscard]] static const LevelCensus& census(const Atlas& atlas);
    /// The trees, without zones of voxels; lives as long as the Atlas. Cost: the first call reads them.
    [[nodiscard]] static const Analysis& analysis(const Atlas& atlas);
    /// The trees from now on, unless there are some: nobody should read what somebody has. analysis: of the store, with voxel counts.
    static void keep(const Atlas& atlas, Analysis analysis);
    [[nodiscard]] static const Container& store(const Atlas& atlas);
    [[nodiscard]] static StoredSamples& samples(const Atlas& atlas);
    /// Adds to what Atlas::reads() tells, and to `cost`.
    static void count(const Atlas& atlas, const LevelQuery& spent, std::int64_t active, QueryCost* cost);
};

}  // namespace isoatlas
