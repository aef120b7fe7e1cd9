// Internal access to an Atlas for the other files of this folder.
#pragma once

#include <cstdint>
#include <memory>

namespace isoatlas {

class Analysis;
class Atlas;
class Container;
class StoredSamples;
struct LevelCensus;
struct LevelQuery;
struct QueryCost;

/// Trees in memory, with their index (atlas/atlas.cpp).
struct AtlasTrees;

struct AtlasAccess {
    /// Loaded on first use.
    [[nodiscard]] static const LevelCensus& census(const Atlas& atlas);
    /// The trees, without zones of voxels; lives as long as the Atlas. Cost: the first call reads them.
    [[nodiscard]] static const Analysis& analysis(const Atlas& atlas);
    /// Sets the trees unless they are loaded, to avoid reading them again. analysis: of the store, with voxel counts.
    static void keep(const Atlas& atlas, Analysis analysis);
    /// Those of another store of the same samples and polarity.
    static void keep(const Atlas& atlas, std::shared_ptr<const AtlasTrees> trees);
    [[nodiscard]] static std::shared_ptr<const AtlasTrees> trees(const Atlas& atlas);
    [[nodiscard]] static const Container& store(const Atlas& atlas);
    [[nodiscard]] static StoredSamples& samples(const Atlas& atlas);
    /// Adds to Atlas::reads() and to `cost`.
    static void count(const Atlas& atlas, const LevelQuery& spent, std::int64_t active, QueryCost* cost);
};

}  // namespace isoatlas
