// Atlas: a volume, its trees and its bricks in one file, from which any surface is served without reading the rest.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/active.h"
#include "isoatlas/analysis.h"
#include "isoatlas/bounds.h"
#include "isoatlas/cavities.h"
#include "isoatlas/cut.h"
#include "isoatlas/filter.h"
#include "isoatlas/objects.h"
#include "isoatlas/polarity.h"
#include "isoatlas/samples_wanted.h"
#include "isoatlas/simplify.h"
#include "isoatlas/surface.h"
#include "isoatlas/units.h"
#include "isoatlas/volume.h"

namespace isoatlas {

struct FrontOptions;  // isoatlas/octree_front.h
struct FrontSurface;

/// Totals of what the queries of an Atlas have read.
struct AtlasReads {
    std::int64_t bytes = 0;    ///< of samples
    std::int64_t extents = 0;  ///< reads
    std::int64_t bricks = 0;   ///< of 16 x 8 x 8 samples
};

/// Cost of one query. A cell belongs to the brick of its first corner.
struct QueryCost : AtlasReads {
    std::int64_t cells_loaded = 0;   ///< of the bricks that were read; those that were present cost nothing
    std::int64_t cells_visited = 0;  ///< of the bricks whose samples were examined, present or not
    std::int64_t cells_active = 0;   ///< that the requested surface passes through (cells at the border of the volume included)
    /// Which part of the cells loaded, or visited, is active; 0 when there are none.
    [[nodiscard]] double load_utility() const { return ratio(cells_active, cells_loaded); }
    [[nodiscard]] double travel_utility() const { return ratio(cells_active, cells_visited); }
    QueryCost& operator+=(const QueryCost& other);

private:
    static double ratio(std::int64_t a, std::int64_t b) { return b == 0 ? 0 : static_cast<double>(a) / static_cast<double>(b); }
};

/// Size of the surface at an isovalue and cost of its query, before any brick is read.
struct SurfacePreview {
    double tau = 0;
    std::int64_t objects = 0, contours = 0, tunnels = 0;
    Bounds voxels;                  ///< of all objects together
    Bounds cells;                   ///< that the surface passes through
    Bounds points;                  ///< of the compact, closed surface, without articulation points (about one for 1000 points)
    Bounds triangles;               ///< of the same (2D: segments)
    Bounds bricks, bytes, extents;  ///< to be read by a first query; fewer when bricks are present
};

/// A volume reduced to means of cubes of samples.
struct CoarseVolume {
    std::int64_t step = 1;    ///< samples along the edge of a cube
    Extent extent;            ///< cubes
    std::vector<float> mean;  ///< of the samples of each cube, x fastest; stored values. Those at the far ends are of what is left
};

/// Does a file begin like a store, even a damaged one? False for files that cannot be read.
[[nodiscard]] bool is_atlas(const std::string& path);

struct AtlasOptions {
    /// Limit of the memory of samples that no query needs at the moment; the least recently used ones are evicted first. 0: none, what was
    /// read stays. A query that alone needs more gets more until it is done.
    std::int64_t cache_bytes = 0;
    /// Which objects: of high values (samples as they are), or of low ones (all samples, ranges, values and isovalues are those of the
    /// negated volume, isoatlas/polarity.h). None: those of high values if it holds them, else those of low ones.
    std::optional<Polarity> polarity{};
    /// Of Atlas::info(), in memory: what the queries return follows from them, as if the store had been built with them.
    Corrections corrections{};
};

/// As CutOptions, with the interpolant of the store.
struct AtlasCutOptions {
    bool label = false;  ///< fill Cut::label (4 bytes a voxel)
};

/// A store, open for reading. Queries are thread safe.
class Atlas {
public:
    /// Cost: reads the table of contents and what there is about every brick. Throws Error: input (missing, not a store, damaged),
    /// unsupported (a later version, or it does not hold the polarity), usage (another spacing for a store of filtered samples).
    explicit Atlas(const std::string& path, const AtlasOptions& options = {});
    Atlas(Atlas&&) noexcept;
    Atlas& operator=(Atlas&&) noexcept;
    ~Atlas();

    [[nodiscard]] const VolumeInfo& info() const;
    [[nodiscard]] PolarityChoice polarities() const;  ///< that it can be opened for; polarity_of(info()): for which it is
    [[nodiscard]] Interpolant interpolant() const;
    [[nodiscard]] double tunnel_height() const;         ///< of AnalysisOptions
    [[nodiscard]] std::array<double, 2> range() const;  ///< lowest and highest sample
    [[nodiscard]] std::int64_t file_bytes() const;
    [[nodiscard]] int version() const;          ///< of the format
    [[nodiscard]] bool is_replaceable() const;  ///< BuildOptions::is_replaceable
    /// Does it hold the values that this version would compute from its samples? Not before version 3: saddles were rounded differently.
    [[nodiscard]] bool has_present_values() const;

    /// The same as cut() and extract() of the volume, with the interpolant of the store. Bricks that the isovalue does not divide and that
    /// no active cell touches are not read. What the query has cost is added to `cost`.
    [[nodiscard]] Cut cut(double tau, const AtlasCutOptions& options = {}, const Context& context = {}, QueryCost* cost = nullptr) const;
    [[nodiscard]] Surface extract(double tau, const SurfaceOptions& options = {}, const Context& context = {},
                                  QueryCost* cost = nullptr) const;

    /// As extract_front() of the volume (isoatlas/octree_front.h); options.exact and options.eye are of the whole volume.
    [[nodiscard]] FrontSurface extract_front(double tau, const FrontOptions& options, const SurfaceOptions& surface = {},
                                             const Context& context = {}, QueryCost* cost = nullptr) const;

    /// The objects and contours at an isovalue, as in cut(), from the trees alone: no brick is read. Throws Error: usage (tau is not
    /// finite), input (damaged), cancelled. Cost: the first call reads the trees; then O((1 + what is listed) log events).
    [[nodiscard]] ActiveObjects active(double tau, bool contours = true, const Context& context = {}) const;
    /// The index behind active(), also for changes between two isovalues; lives as long as the Atlas. Cost: the first call reads the trees.
    [[nodiscard]] const ActiveIndex& active_index() const;

    /// Size and cost of extract() and cut() of the whole volume. For 8-bit samples, and for 16-bit ones of up to voxels / 256 different
    /// values, voxels, cells and points are exact; else bounded by the values around tau. Cost: the first call reads the trees; then
    /// O(bricks + objects log events).
    [[nodiscard]] SurfacePreview preview(double tau, const Context& context = {}) const;

    /// The table of objects, as from rank_objects(). Cost: reads the table, which is stored; with a selection the trees too. Without the
    /// gate, with a selection that keeps more than what passes the gate, for more than 1024 entries where there are so many, and for
    /// volumes of more than 2^24 voxels, the volume is read and analysed again.
    [[nodiscard]] ObjectTable objects(const RankOptions& options = {}, const Context& context = {}) const;

    /// The table of cavities, as from rank_cavities(). Cost: as objects(); with any selection the volume is read and analysed again.
    [[nodiscard]] CavityTable cavities(const RankOptions& options = {}, const Context& context = {}) const;

    /// The branches of the criticality tree, for selections and simplified trees. Cost: reads the trees and no sample. Of volumes with more
    /// than one critical element for three voxels, of grids with uneven steps, and of stores of early versions, all samples are read and
    /// their zones found again.
    [[nodiscard]] BranchHierarchy hierarchy(const Context& context = {}) const;

    /// The trees, without zones of voxels.
    [[nodiscard]] Analysis analysis() const;
    /// All samples. Cost: reads all bricks.
    [[nodiscard]] Volume volume(const Context& context = {}) const;
    /// The same with the requested samples; the others are the lowest one of their brick, so that no other cell has a value in the ranges.
    /// Cost: memory for all samples; reads bricks with such samples and those around them, found by their lowest and highest samples.
    [[nodiscard]] Volume volume(const SamplesWanted& wanted, const Context& context = {}, QueryCost* cost = nullptr) const;

    /// Every step-th sample of a box, from its first one on, placed where they lie in space. Throws Error{usage} when the box is empty or
    /// exceeds the volume, or the step is less than 1. Cost: reads the bricks that hold one of them, and keeps none; memory: the result.
    [[nodiscard]] Volume samples(const SampleBox& box, std::int64_t step = 1, const Context& context = {}) const;
    /// The whole volume coarser: means of cubes of step^3 samples, step the first power of two that leaves at most `max` of them. Throws
    /// Error: usage (max is less than 1), cancelled. Cost: reads all bricks, and keeps none; memory: the result and, where the step is more
    /// than 8, 4 bytes for 512 samples.
    [[nodiscard]] CoarseVolume coarse(std::int64_t max, const Context& context = {}) const;

    /// How many samples lie in [edges[i], edges[i + 1]); the last count includes its end. Stored values, ascending, two at least. Throws
    /// Error{usage}. Cost: reads the bricks with samples on both sides of an edge.
    [[nodiscard]] std::vector<std::int64_t> histogram(std::span<const double> edges, const Context& context = {}) const;

    /// Was the store made of this volume: as many samples along each axis, and the same? Those that were filtered or replaced when it was
    /// made differ. Throws as VolumeReader::read(), cancelled. Cost: reads the volume once, unless its header decides; memory: some slices.
    [[nodiscard]] bool is_of(VolumeReader& volume, const Context& context = {}) const;
    /// Of all queries so far.
    [[nodiscard]] AtlasReads reads() const;
    /// Compares every byte that has a checksum with it, and the samples, which it returns, with those the store was made of. Throws
    /// Error{input} for the first that differs. Cost: reads the whole store.
    Volume check(const Context& context = {}) const;
    /// Evicts the bricks that earlier queries have read.
    void clear_cache() const;
    /// Memory of the samples that are present, in pages of the system.
    [[nodiscard]] std::int64_t present_bytes() const;

private:
    friend struct AtlasAccess;
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
