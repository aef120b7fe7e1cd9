// Levels of detail of the objects of a store, made once and kept beside it: STORE.lod.
//
// A file of levels holds cluster hierarchies (cluster_hierarchy.h) in the container of stores: checksums, parts that can be read alone,
// also from a web server. docs/format.md describes it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/atlas.h"
#include "isoatlas/cluster_hierarchy.h"

namespace isoatlas {

/// A surface of a store: an object at an isovalue, or the wall of a cavity.
struct LevelsKey {
    std::int64_t voxel = -1;  ///< ObjectEntry::id, or a contour id as in Cut
    double tau = 0;           ///< stored value
    bool is_contour = false;
    friend bool operator==(const LevelsKey&, const LevelsKey&) = default;
};

/// A surface whose levels a file holds.
struct PreparedLevels {
    LevelsKey key;
    std::int64_t triangles = 0;  ///< of the exact surface
    std::int64_t coarsest = 0;   ///< of the coarsest one
    double distance = 0;         ///< of the coarsest one from the exact one, at most, in voxels
};

/// A surface that is finer where the eye is near.
struct SeenSurface {
    SimplifiedSurface simplified;  ///< its distance in voxels, where it is greatest
    double pixels = 0;             ///< no point of it is seen farther than so many pixels from the exact surface, nor back
};

struct LevelsOptions {
    /// Bytes: large arrays lie in a scratch file in PATH.build, mapped as far as this allows. What extract() needs of a store, the samples
    /// of the bricks on the surface, is in memory, too. 0: half of the available memory, for surfaces that need more.
    std::int64_t memory = 0;
};

/// The file beside a store: STORE.lod; of low values: scan.low.atlas.lod beside scan.atlas, as beside scan.low.atlas.
[[nodiscard]] std::string levels_path(const std::string& store, Polarity polarity = Polarity::high);

/// Makes the levels of surfaces of a store, one after the other, each kept in the folder PATH.build as soon as it is finished, so that an
/// interrupted call goes on where it ended; then writes the file: what it held before and the new ones. Returns what it holds. Of the same
/// surfaces in the same order the same bytes, for any number of threads and interruptions. Throws Error: as Atlas::extract() and
/// make_clusters(), input (the file is damaged, or of another store), unsupported (a 2D image), resource, cancelled. Cost: some 150 us a
/// triangle on one processor; memory: that of the largest surface, some 400 bytes a triangle, or what the options allow.
std::vector<PreparedLevels> make_levels(const Atlas& atlas, const std::string& path, std::span<const LevelsKey> surfaces,
                                        const LevelsOptions& options = {}, const Context& context = {});

/// An open file of levels. Reading is thread safe.
class Levels {
public:
    /// atlas: of the store that they were made of, which may be read from somewhere else. Throws Error: input (missing, damaged, of another
    /// store), unsupported (a later version). Cost: reads the tables of clusters, some bytes for a thousand triangles.
    Levels(const std::string& path, const Atlas& atlas);
    ~Levels();
    Levels(Levels&&) noexcept;
    Levels& operator=(Levels&&) noexcept;

    [[nodiscard]] const std::vector<PreparedLevels>& surfaces() const;
    /// Its place in surfaces(); -1: the file does not hold it.
    [[nodiscard]] std::int64_t find(const LevelsKey& key) const;
    /// The coarsest surface in which every group is at most so far from the exact one, in voxels; 0: the exact one. Throws Error{input} for
    /// damage. Cost: reads what the surface needs, and what coarser ones do.
    [[nodiscard]] SimplifiedSurface within(std::int64_t surface, double distance) const;
    /// The nearest one of those with at most so many triangles; the coarsest, if it has more.
    [[nodiscard]] SimplifiedSurface at_most(std::int64_t surface, std::int64_t triangles) const;
    /// The one of which no part is seen farther than `pixels` from the exact surface; if it has more triangles than that, the nearest one
    /// of those with at most so many, or the coarsest. Throws Error: usage (a length of the viewpoint or pixels is not positive), input
    /// (damage). Cost: reads what the surface needs.
    [[nodiscard]] SeenSurface seen_from(std::int64_t surface, const Viewpoint& from, double pixels, std::int64_t triangles) const;
    /// All levels. Throws Error{input} for damage.
    [[nodiscard]] ClusterHierarchy hierarchy(std::int64_t surface) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
