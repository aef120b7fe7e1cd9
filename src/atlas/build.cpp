// Building a store: trees, zones, pack. Every phase writes a file from which the next one, or another process, continues.
#include "isoatlas/build.h"

#include <algorithm>

#include "atlas/build_fingerprint.h"
#include "atlas/build_folder.h"
#include "atlas/census_arrays.h"
#include "atlas/tree_arrays.h"
#include "atlas/zone_phase.h"
#include "base/big_vector.h"
#include "base/cancel.h"
#include "base/check.h"
#include "base/memory_limit.h"
#include "base/phase.h"
#include "base/streamed.h"
#include "census/level_census.h"
#include "codec/checksum.h"
#include "field/gaussian.h"
#include "field/volume_view.h"
#include "formats/volume/load_samples.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "store/brick_writer.h"
#include "store/container.h"
#include "store/pack.h"

namespace isoatlas {
namespace {

/// Those of analyse() in the middle.
constexpr PhasePlan<8> kBuildPhases{{"read", "classify", "basins", "sort", "trees", "zones", "objects", "pack"}};
constexpr const char* kTrees = "trees";
constexpr const char* kZones = "zones";

/// Progress of a part of the build, numbered as phases of the whole.
Context shifted(const Context& context, int by, const Extent& extent) {
    Context part = context;
    if (!context.progress) return part;
    part.progress = [&context, by, voxels = extent.voxels()](const Progress& progress) {
        context.progress({progress.phase, progress.phase_index + by, kBuildPhases.count(), progress.fraction, voxels});
    };
    return part;
}

/// Of samples that may be larger than memory.
std::uint64_t checksum_of(std::span<const std::byte> samples) {
    constexpr std::size_t kPart = std::size_t{1} << 22;
    Checksum sum;
    for (const Block block : streamed_blocks(samples.size(), kPart)) sum.add(samples.subspan(block.first, block.size()));
    return sum.sum();
}

/// fingerprint: of file and options. samples: checksum of those in the file; nullopt: equal to the analysed ones.
Contents contents_of(const VolumeView& volume, const AnalysisOptions& options, Fingerprint fingerprint,
                     std::optional<std::uint64_t> samples) {
    Contents contents;
    contents.volume = *volume.info;
    const std::size_t slash = volume.info->path.rfind('/');
    if (slash != std::string::npos) contents.volume.path = volume.info->path.substr(slash + 1);  // its location is irrelevant
    const std::size_t bytes = static_cast<std::size_t>(volume.info->extent.voxels()) * size_of(volume.info->type);
    contents.parameters = {options.interpolant, options.tunnel_height, checksum_of({volume.bytes, bytes})};
    const std::uint64_t analysed = contents.parameters.samples_checksum;
    add_samples(fingerprint, samples.value_or(analysed), analysed);
    contents.fingerprint = std::move(fingerprint);
    return contents;
}

/// Progress counts bytes of the written bricks; all else is copied.
void report_packing(std::vector<PackedArray>& arrays, const Context& context) {
    double total = 0;
    for (const PackedArray& array : arrays) total += array.chunk > 0 ? 0 : static_cast<double>(array.bytes());
    const auto done = std::make_shared<double>(0);
    for (PackedArray& array : arrays) {
        if (array.chunk > 0) continue;
        array.feed = [feed = std::move(array.feed), done, total, context](const ByteSink& put) {
            feed([&](std::span<const std::byte> bytes) {
                stop_if_cancelled(context);
                put(bytes);
                *done += static_cast<double>(bytes.size());
                report(context, kBuildPhases["pack"], total > 0 ? *done / total : 1);
            });
        };
    }
}

/// Highest minus lowest sample of a volume that may exceed memory.
double range_of(const VolumeView& volume) {
    return visit_samples(volume, []<class T>(std::span<const T> samples) {
        constexpr std::size_t kPart = std::size_t{1} << 20;
        T low = samples[0], high = samples[0];
        for (const Block block : streamed_blocks(samples.size(), kPart)) {
            const auto [min, max] = std::ranges::minmax(samples.subspan(block.first, block.size()));
            low = std::min(low, min), high = std::max(high, max);
        }
        return static_cast<double>(high) - static_cast<double>(low);
    });
}

class Build {
public:
    Build(const std::string& path, bool restart, const Context& context) : path_(path), folder_(path, restart), context_(context) {
        context_.environment = nullptr;  // that of this thread: with the budget of the build
        context_.progress = [this, told = context.progress](const Progress& progress) {
            folder_.say(clock_.at(progress));
            if (told) told(progress);
        };
    }

    /// Context of the caller; progress is also published to other processes. Valid for the lifetime of this.
    [[nodiscard]] const Context& context() const { return context_; }

    [[nodiscard]] const std::string& scratch_folder() const { return folder_.path(); }

    BuildReport run(const VolumeView& volume, const AnalysisOptions& options, const Contents& contents) {
        std::optional<ContourArcs> arcs;
        std::unique_ptr<Container> trees = finished(kTrees, contents);
        if (trees) {
            report_.resumed.emplace_back(kTrees);
        } else {
            arcs = compute_arcs(volume, options, shifted(context_, 1, volume.info->extent));
            pack_store(folder_.file(kTrees), contents, tree_arrays(*arcs, *volume.info, context_.threads));
            trees = std::make_unique<Container>(folder_.file(kTrees));
        }
        std::unique_ptr<Container> zones = finished(kZones, contents);
        if (zones) {
            report_.resumed.emplace_back(kZones);
        } else {
            if (!arcs) arcs = arcs_of(*trees, volume.bytes, context_);
            const Context part = shifted(context_, 1, volume.info->extent);
            const auto done = [this](double fraction) { report(context_, kBuildPhases["objects"], fraction); };
            const std::unique_ptr<ZonePhase> made = zone_phase(std::move(*arcs), volume, context_, part, done);
            pack_store(folder_.file(kZones), contents, made->arrays);
            zones = std::make_unique<Container>(folder_.file(kZones));
        }
        arcs.reset();
        trim_memory_pool();
        pack(volume, contents, {trees.get(), zones.get()});
        return report_;
    }

private:
    /// Unused phases are reported; those with the same reason together.
    [[nodiscard]] std::unique_ptr<Container> finished(const std::string& phase, const Contents& contents) {
        std::string why_not;
        std::unique_ptr<Container> found = folder_.finished(phase, contents, why_not);
        if (why_not.empty()) return found;
        const std::string reason = " of an earlier build are not used: " + why_not;
        const bool is_same = !report_.not_used.empty() && report_.not_used.back().ends_with(reason);
        if (is_same)
            report_.not_used.back().insert(report_.not_used.back().size() - reason.size(), ", " + phase);
        else
            report_.not_used.push_back(phase + reason);
        return found;
    }

    void pack(const VolumeView& volume, const Contents& contents, const std::vector<const Container*>& phases) {
        std::vector<PackedArray> arrays = brick_arrays(volume, context_);
        for (const Container* phase : phases) {
            for (PackedArray& array : copied_arrays(*phase)) arrays.push_back(std::move(array));
        }
        const LevelCensus census = take_census(volume, context_);
        for (PackedArray& array : census_arrays(census)) arrays.push_back(std::move(array));
        report_packing(arrays, context_);
        report_.bytes = pack_store(path_, contents, arrays);
        if (!folder_.remove()) report_.left_behind = folder_.path();
        report_.peak_memory = peak_memory();
    }

    std::string path_;
    BuildFolder folder_;
    BuildClock clock_;
    Context context_;
    BuildReport report_;
};

}  // namespace

BuildReport build_atlas(const std::string& path, VolumeReader& reader, const BuildOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    Build build(path, options.restart, context);  // obstacles are reported before anything is read
    const BuildEstimate estimate = estimate_build(reader, path, options, context.threads);
    check_estimate(estimate, reader.info().path, path);
    const MemoryLimit limit(estimate.uses_scratch ? estimate.budget : 0, build.scratch_folder());
    BigVector<std::byte> samples;
    const Allocate allocate = [&samples](std::size_t bytes) {
        samples.resize(bytes);
        return std::span<std::byte>(samples);
    };
    SummingReader summed(reader);
    VolumeInfo info = load_samples(summed, options.missing, allocate, shifted(build.context(), 0, reader.info().extent));
    if (options.geometry) info.geometry = *options.geometry;
    if (options.gaussian > 0) filter_in_place(info, samples.data(), options.gaussian, build.context());
    const VolumeView volume(info, samples.data());
    AnalysisOptions analysis = options.analysis;
    if (options.tunnel_height_percent > 0) analysis.tunnel_height = options.tunnel_height_percent / 100 * range_of(volume);
    Fingerprint fingerprint = header_fingerprint(reader.info(), options, analysis.tunnel_height);
    Contents contents = contents_of(volume, analysis, std::move(fingerprint), summed.sum());
    contents.is_replaceable = options.is_replaceable;
    return build.run(volume, analysis, contents);
}

BuildReport build_atlas(const std::string& path, const Volume& volume, const AnalysisOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    ISOATLAS_CHECK(static_cast<std::int64_t>(volume.bytes.size() / size_of(volume.info.type)) == volume.info.extent.voxels());
    BuildOptions asked;
    asked.analysis = options;
    asked.gaussian = volume.info.gaussian;
    const Contents contents = contents_of(volume, options, header_fingerprint(volume.info, asked, options.tunnel_height), std::nullopt);
    return Build(path, false, context).run(volume, options, contents);
}

}  // namespace isoatlas
