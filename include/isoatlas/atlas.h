// Atlas: a volume, its trees and its bricks in one file, from which any surface is served without reading the rest.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "isoatlas/analysis.h"
#include "isoatlas/cut.h"
#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// What the queries of an Atlas have read so far.
struct AtlasReads {
    std::int64_t bytes = 0;    ///< of samples
    std::int64_t extents = 0;  ///< reads
    std::int64_t bricks = 0;   ///< of 16 samples a side
};

/// Does a file begin like a store? False for files that cannot be read.
[[nodiscard]] bool is_atlas(const std::string& path);

/// A store, open for reading. Queries may come from many threads.
class Atlas {
public:
    /// Cost: reads the table of contents and what there is about every brick. Throws Error: input (missing, no store, damaged),
    /// unsupported (a later version).
    explicit Atlas(const std::string& path);
    Atlas(Atlas&&) noexcept;
    Atlas& operator=(Atlas&&) noexcept;
    ~Atlas();

    [[nodiscard]] const VolumeInfo& info() const;
    [[nodiscard]] Interpolant interpolant() const;
    [[nodiscard]] double tunnel_height() const;         ///< of AnalysisOptions
    [[nodiscard]] std::array<double, 2> range() const;  ///< lowest and highest sample
    [[nodiscard]] std::int64_t file_bytes() const;

    /// The same as cut() and extract() of the volume, with the interpolant of the store whatever the options say. Bricks that the isovalue
    /// does not divide and that no active cell touches are not read.
    [[nodiscard]] Cut cut(double tau, const CutOptions& options = {}, const Context& context = {}) const;
    [[nodiscard]] Surface extract(double tau, const ExtractOptions& options = {}, const Context& context = {}) const;

    /// The trees, without zones of voxels.
    [[nodiscard]] Analysis analysis() const;
    /// All samples. Cost: reads all bricks.
    [[nodiscard]] Volume volume(const Context& context = {}) const;

    [[nodiscard]] AtlasReads reads() const;
    /// Compares every byte that has a checksum with it, and the samples, which it returns, with those the store was made of. Throws
    /// Error{input} for the first that differs. Cost: reads the whole store.
    Volume check(const Context& context = {}) const;
    /// Forgets the bricks that earlier queries have read. Not while a query runs.
    void clear_cache() const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
