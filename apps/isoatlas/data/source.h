// Source: one interface to a volume file or a store (`isoatlas build`) for the verbs.
//
// A volume file is read whole, a store only as far as a query needs.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include <isoatlas/isoatlas.h>

#include "data/octree.h"
#include "data/session.h"

namespace isoatlas::cli {

/// Verbs that filter and crop the samples of a store; the others take those that its trees were made of.
[[nodiscard]] bool filters_stores(const std::string& verb);

/// Options that are fixed when a store is built: throws Error{usage} when one contradicts the store.
void check_store_options(const Arguments& arguments, const Atlas& atlas);

class Source {
public:
    /// Opens arguments.file, prints one line about it and the notes of the reader.
    Source(const Arguments& arguments, Terminal& terminal);

    [[nodiscard]] bool is_store() const { return atlas_.has_value(); }
    /// Stores only.
    [[nodiscard]] const Atlas& atlas() const { return atlas_.value(); }
    [[nodiscard]] const VolumeInfo& info() const { return info_; }
    [[nodiscard]] ValueRange range();
    [[nodiscard]] Interpolant interpolant() const;
    [[nodiscard]] double tunnel_height();  ///< stored values
    [[nodiscard]] AnalysisOptions analysis_options() { return {.interpolant = interpolant(), .tunnel_height = tunnel_height()}; }
    /// The stored isovalue of --tau. Throws Error{not_found} with the range when no sample of the volume has it between them.
    [[nodiscard]] double tau() { return stored(*arguments_.tau); }
    /// The same for any isovalue that the user typed.
    [[nodiscard]] double stored(double typed);
    [[nodiscard]] Context context() { return session_.context(); }

    [[nodiscard]] Cut cut(double tau, bool label);
    /// options: interpolant and tunnel height are those of the source.
    /// With --octree by blocks of cells.
    [[nodiscard]] Surface extract(double tau, const SurfaceOptions& options);
    [[nodiscard]] const OctreeUse& octree() const { return octree_; }
    /// The table of objects.
    [[nodiscard]] ObjectTable objects(const RankOptions& options);
    [[nodiscard]] CavityTable cavities(const RankOptions& options);
    [[nodiscard]] ObjectsAndCavities objects_and_cavities(const RankOptions& options);
    /// The branches that selections choose from.
    [[nodiscard]] BranchHierarchy hierarchy();
    /// The same, with the trees that its events belong to.
    [[nodiscard]] std::pair<Analysis, BranchHierarchy> analysis_and_hierarchy();
    /// The selection of the command line, in stored values.
    [[nodiscard]] Selection selection();
    [[nodiscard]] Spectrum spectrum(const SpectrumOptions& options);
    /// The objects at an isovalue, or those that contain one of these voxels.
    [[nodiscard]] std::vector<ObjectMeasures> measure(double tau, const std::vector<std::int64_t>& objects);
    /// The labels of a label volume.
    [[nodiscard]] std::vector<ObjectMeasures> measure_labels();
    /// Of the samples of the file, whichever the polarity: how many have values below those of these (stored, ascending) isovalues.
    [[nodiscard]] std::vector<std::int64_t> samples_below(const std::vector<double>& taus);
    /// Likewise: high and low values of the file.
    [[nodiscard]] Percolation percolation();
    /// The trees. with_zones: zone(voxel) is needed.
    [[nodiscard]] Analysis analysis(bool with_zones);
    /// All samples.
    [[nodiscard]] const Volume& volume();
    /// Frees the trees that tables of a volume file were made from.
    void release_trees() { ranked_.reset(); }
    /// A volume with at least these samples; no others are read from a store. Valid until the next call.
    [[nodiscard]] const Volume& volume(const SamplesWanted& wanted);

    /// Read statistics of a store, for the JSON documents; nullopt for a volume file.
    [[nodiscard]] std::optional<QueryCost> reads() const;

private:
    /// Of a volume file, for tables.
    [[nodiscard]] const Analysis& ranked();
    [[nodiscard]] bool filters_samples() const;

    const Arguments& arguments_;
    Session session_;
    std::optional<Analysis> ranked_;
    std::optional<Atlas> atlas_;
    std::optional<Volume> volume_, part_;
    std::optional<ValueRange> range_;
    QueryCost cost_;
    OctreeUse octree_;
    VolumeInfo info_;
};

}  // namespace isoatlas::cli
