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
#include "field/negate.h"
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
constexpr const char* kHighValues = "high-values";

/// Between "read" and "pack", once for each polarity.
constexpr int kRepeated = kBuildPhases.count() - 2;

/// Numbered over all passes: pass 0 of n has the phases 1 to kRepeated.
Progress numbered(const Progress& progress, int pass, int passes) {
    Progress whole = progress;
    const bool is_packing = progress.phase_index == kBuildPhases.count() - 1;
    if (progress.phase_index > 0) whole.phase_index += kRepeated * (is_packing ? passes - 1 : pass);
    whole.phase_count += kRepeated * (passes - 1);
    return whole;
}

/// Progress of a part of the build, numbered as phases of one pass.
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
                     std::optional<std::uint64_t> samples, PolarityChoice polarities) {
    Contents contents;
    contents.volume = *volume.info;
    const std::size_t slash = volume.info->path.rfind('/');
    if (slash != std::string::npos) contents.volume.path = volume.info->path.substr(slash + 1);  // its location is irrelevant
    const std::size_t bytes = static_cast<std::size_t>(volume.info->extent.voxels()) * size_of(volume.info->type);
    contents.parameters = {options.interpolant, options.tunnel_height, checksum_of({volume.bytes, bytes})};
    const std::uint64_t analysed = contents.parameters.samples_checksum;
    add_samples(fingerprint, samples.value_or(analysed), analysed);
    contents.fingerprint = std::move(fingerprint);
    contents.polarities = polarities;
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

/// The samples of a build, negated or not, in place.
class PolarSamples {
public:
    PolarSamples(VolumeInfo info, std::span<std::byte> samples) : info_(std::move(info)), samples_(samples) {}
    /// Valid until the next call. Cost: a pass over the samples when they are of the other polarity.
    [[nodiscard]] VolumeView as(Polarity polarity) {
        if (polarity != polarity_of(info_)) {
            negate_samples(info_.type, samples_);
            info_ = negated(std::move(info_));
        }
        return {info_, samples_.data()};
    }

private:
    VolumeInfo info_;
    std::span<std::byte> samples_;
};

/// A file that is removed in the end.
class TemporaryStore {
public:
    explicit TemporaryStore(std::string path) : path_(std::move(path)) {}
    ~TemporaryStore() { (void)file_system().remove(path_); }
    TemporaryStore(const TemporaryStore&) = delete;
    TemporaryStore& operator=(const TemporaryStore&) = delete;
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
};

class Build {
public:
    Build(const std::string& path, bool restart, PolarityChoice polarities, const Context& context)
        : path_(path), folder_(path, restart), context_(context), passes_(polarities == PolarityChoice::both ? 2 : 1) {
        context_.environment = nullptr;  // that of this thread: with the budget of the build
        context_.progress = [this, told = context.progress](const Progress& of_pass) {
            const Progress progress = numbered(of_pass, pass_, passes_);
            folder_.say(clock_.at(progress));
            if (told) told(progress);
        };
    }

    /// Context of the caller; progress is also published to other processes. Valid for the lifetime of this.
    [[nodiscard]] const Context& context() const { return context_; }

    [[nodiscard]] const std::string& scratch_folder() const { return folder_.path(); }

    using UseStore = std::function<void(const std::string& store, const Context& context)>;

    /// high_values: BuildOptions::high_values, or empty.
    BuildReport run(PolarSamples& samples, const AnalysisOptions& options, const Contents& contents, const UseStore& high_values) {
        std::vector<Part> parts;
        for (const Polarity polarity : {Polarity::high, Polarity::low}) {
            if (!holds(contents.polarities, polarity)) continue;
            pass_ = static_cast<int>(parts.size());
            parts.push_back(part_of(samples.as(polarity), options, contents));
            const bool is_first_of_both = contents.polarities == PolarityChoice::both && polarity == Polarity::high;
            if (is_first_of_both && high_values) lend(samples.as(polarity), contents, parts, high_values);
        }
        std::ranges::reverse(parts);                        // as they lie in the file
        pack(samples.as(Polarity::high), contents, parts);  // the bricks are those of the file's samples
        return report_;
    }

private:
    /// What the store holds of one polarity.
    struct Part {
        Polarity polarity;
        std::unique_ptr<Container> trees, zones;
        std::unique_ptr<LevelCensus> census;
        std::vector<PackedArray> places;  ///< low: of the extremes of bricks
    };

    [[nodiscard]] Part part_of(const VolumeView& volume, const AnalysisOptions& options, const Contents& contents) {
        Part part{.polarity = polarity_of(*volume.info), .trees = {}, .zones = {}, .census = {}, .places = {}};
        const std::string before = part.polarity == Polarity::low ? "low-" : "", trees = before + kTrees, zones = before + kZones;
        std::optional<ContourArcs> arcs;
        part.trees = finished(trees, contents);
        if (part.trees) {
            report_.resumed.emplace_back(trees);
        } else {
            arcs = compute_arcs(volume, options, shifted(context_, 1, volume.info->extent));
            pack_store(folder_.file(trees), contents, tree_arrays(*arcs, *volume.info, context_.threads));
            part.trees = std::make_unique<Container>(folder_.file(trees));
        }
        part.zones = finished(zones, contents);
        if (part.zones) {
            report_.resumed.emplace_back(zones);
        } else {
            if (!arcs) arcs = arcs_of(*part.trees, volume.bytes, context_);
            const Context counting = shifted(context_, 1, volume.info->extent);
            const auto done = [this](double fraction) { report(context_, kBuildPhases["objects"], fraction); };
            const std::unique_ptr<ZonePhase> made = zone_phase(std::move(*arcs), volume, context_, counting, done);
            pack_store(folder_.file(zones), contents, made->arrays);
            part.zones = std::make_unique<Container>(folder_.file(zones));
        }
        arcs.reset();
        trim_memory_pool();
        part.census = std::make_unique<LevelCensus>(take_census(volume, context_));
        if (part.polarity == Polarity::low) part.places = brick_place_arrays(volume, context_);
        return part;
    }

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

    /// A store of high values, while it is used.
    void lend(const VolumeView& volume, Contents contents, const std::vector<Part>& parts, const UseStore& use) {
        contents.polarities = PolarityChoice::high;
        Context quiet = context_;
        quiet.progress = nullptr;
        const TemporaryStore store(folder_.file(kHighValues));
        pack_store(store.path(), contents, arrays_of(volume, parts, quiet));
        use(store.path(), quiet);
        trim_memory_pool();
    }

    [[nodiscard]] static std::vector<PackedArray> arrays_of(const VolumeView& volume, const std::vector<Part>& parts,
                                                            const Context& context) {
        std::vector<PackedArray> arrays = brick_arrays(volume, context);
        for (const Part& part : parts) {
            const auto add = [&](std::vector<PackedArray> more) {
                for (PackedArray& array : more) {
                    if (part.polarity == Polarity::low) array.name.insert(0, kLowGroup);
                    arrays.push_back(std::move(array));
                }
            };
            add(part.places);
            for (const Container* phase : {part.trees.get(), part.zones.get()}) add(copied_arrays(*phase));
            add(census_arrays(*part.census));
        }
        return arrays;
    }

    void pack(const VolumeView& volume, const Contents& contents, const std::vector<Part>& parts) {
        std::vector<PackedArray> arrays = arrays_of(volume, parts, context_);
        report_packing(arrays, context_);
        report_.bytes = pack_store(path_, contents, arrays);
        if (!folder_.remove()) report_.left_behind = folder_.path();
        report_.peak_memory = peak_memory();
    }

    std::string path_;
    BuildFolder folder_;
    BuildClock clock_;
    Context context_;
    int passes_, pass_ = 0;
    BuildReport report_;
};

}  // namespace

BuildReport build_atlas(const std::string& path, VolumeReader& reader, const BuildOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    Build build(path, options.restart, options.polarities, context);  // obstacles are reported before anything is read
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
    Contents contents = contents_of(volume, analysis, std::move(fingerprint), summed.sum(), options.polarities);
    contents.is_replaceable = options.is_replaceable;
    PolarSamples both(info, samples);
    const bool has_room = !estimate.uses_scratch && estimate.disk_free - estimate.disk > estimate.store_bytes;
    return build.run(both, analysis, contents, has_room ? options.high_values : nullptr);
}

BuildReport build_atlas(const std::string& path, const Volume& volume, const AnalysisOptions& options, const Context& context,
                        PolarityChoice polarities) {
    const EnvironmentScope scope(context);
    ISOATLAS_CHECK(static_cast<std::int64_t>(volume.bytes.size() / size_of(volume.info.type)) == volume.info.extent.voxels());
    const bool is_high = polarity_of(volume.info) == Polarity::high;
    if (!is_high && polarities == PolarityChoice::high) polarities = PolarityChoice::low;
    BuildOptions asked;
    asked.analysis = options;
    asked.gaussian = volume.info.gaussian;
    asked.polarities = polarities;
    Volume own;  // high values alone: nothing is negated, the volume is used as it is
    if (polarities != PolarityChoice::high) own = is_high ? volume : negated(volume);
    const Volume& file = polarities == PolarityChoice::high ? volume : own;
    const Contents contents =
        contents_of(file, options, header_fingerprint(file.info, asked, options.tunnel_height), std::nullopt, polarities);
    PolarSamples both(file.info, {const_cast<std::byte*>(file.bytes.data()), file.bytes.size()});
    return Build(path, false, polarities, context).run(both, options, contents, nullptr);
}

}  // namespace isoatlas
