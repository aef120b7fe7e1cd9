// Source: one interface to a volume in memory and a store, as data/source.h is of the command line.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <isoatlas/analysis.h>
#include <isoatlas/atlas.h>
#include <isoatlas/cavities.h>
#include <isoatlas/cut.h>
#include <isoatlas/objects.h>
#include <isoatlas/octree_front.h>
#include <isoatlas/simplify.h>
#include <isoatlas/surface.h>
#include <isoatlas/volume.h>

namespace isoatlas::python {

/// Queries are thread safe: what is computed once is computed by one thread, while others that need it wait.
class Source {
public:
    /// options.tunnel_height: stored values.
    Source(std::shared_ptr<const Volume> volume, const AnalysisOptions& options);
    Source(const std::string& store, const AtlasOptions& options);
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    [[nodiscard]] bool is_store() const { return atlas_.has_value(); }
    [[nodiscard]] const Atlas& atlas() const { return atlas_.value(); }
    [[nodiscard]] const VolumeInfo& info() const { return atlas_ ? atlas_->info() : volume_->info; }
    [[nodiscard]] Interpolant interpolant() const { return atlas_ ? atlas_->interpolant() : options_.interpolant; }
    [[nodiscard]] double tunnel_height() const { return atlas_ ? atlas_->tunnel_height() : options_.tunnel_height; }
    /// Lowest and highest sample, stored. Cost: of a volume one pass, once.
    [[nodiscard]] std::array<double, 2> range();
    /// The stored isovalue of a calibrated one. Throws Error{not_found} when no sample is on one of its sides.
    [[nodiscard]] double stored(double reported);

    [[nodiscard]] Cut cut(double tau, bool label, const Context& context);
    [[nodiscard]] Surface extract(double tau, const SurfaceOptions& options, const Context& context);
    [[nodiscard]] FrontSurface extract_front(double tau, const FrontOptions& front, const SurfaceOptions& options, const Context& context);
    [[nodiscard]] ObjectTable objects(const RankOptions& options, const Context& context);
    [[nodiscard]] CavityTable cavities(const RankOptions& options, const Context& context);
    [[nodiscard]] BranchHierarchy hierarchy(const Context& context);
    /// The trees, of a volume with zones. The first call computes or reads them.
    [[nodiscard]] std::shared_ptr<const Analysis> trees(const Context& context);
    /// With zones.
    [[nodiscard]] std::shared_ptr<const Analysis> zones(const Context& context);
    /// All samples. Of a store they are read at every call.
    [[nodiscard]] std::shared_ptr<const Volume> volume(const Context& context);

private:
    /// value(), made by make() at the first call.
    template <class Value, class Make>
    std::shared_ptr<const Value> once(std::shared_ptr<const Value>& value, const Context& context, const Make& make);

    const AnalysisOptions options_;
    const std::shared_ptr<const Volume> volume_;
    const std::optional<Atlas> atlas_;
    std::timed_mutex making_;
    std::mutex ranging_;  ///< a pass over the samples does not wait for an analysis
    std::shared_ptr<const Analysis> trees_;
    std::optional<std::array<double, 2>> range_;
};

}  // namespace isoatlas::python
