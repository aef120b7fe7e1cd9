// Building a store from a volume of any size, within a memory budget, in phases that survive a crash.
//
// Phases: trees (critical elements, criticality tree, contour tree), zones (their sizes), pack (bricks and trees into one file). What a
// finished phase has found lies in the folder PATH.build, written, synced and renamed, until the store is there; a second build of the same
// volume with the same parameters resumes after it. Each phase records its input and parameters, which are compared member by member,
// samples included. Progress of a running build: build_state().
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/context.h"
#include "isoatlas/polarity.h"
#include "isoatlas/volume.h"

namespace isoatlas {

struct BuildOptions {
    AnalysisOptions analysis{};          ///< zones: of no meaning here
    MissingPolicy missing{};             ///< as load_volume()
    std::optional<Geometry> geometry{};  ///< instead of that of the file
    /// Instead of analysis.tunnel_height: percent of the range of the samples that are analysed, filtered ones included; 0: off.
    double tunnel_height_percent = 0;
    double gaussian = 0;  ///< filters the samples first: sigma as of gaussian_filter(); 0: off
    /// Objects of high or of low values (isoatlas/polarity.h), or both in one store, which holds the samples once. Cost of both: that of
    /// two builds. low and both: missing samples of MissingPolicy::Action::below would be objects; above is for low.
    PolarityChoice polarities = PolarityChoice::high;
    /// Bytes, 80 MiB or more; 0: half of what the machine or its control group has. The whole process stays within it, or within the sum of
    /// all budgets where other builds run at the same time (environment.h). Of no meaning in an environment with a budget, which holds.
    std::int64_t memory = 0;
    bool restart = false;  ///< discards finished phases
    /// Which volume of its file the reader reads, as in OpenOptions: recorded to compare phases and stores.
    std::optional<std::int64_t> time_step{};
    /// Of both polarities: called with a store of the objects of high values alone, before those of low values are looked for. It is there
    /// until the call returns. Not called where the budget needs a scratch file, or the disk has no room for that store.
    std::function<void(const std::string& store, const Context& context)> high_values{};
    /// Marks the store as a by-product of a page, which may be rebuilt with other options. The mark changes no result.
    bool is_replaceable = false;
};

/// Estimated cost of a build; critical elements are counted in a few slabs of the volume.
struct BuildEstimate {
    std::int64_t critical_elements = 0;
    std::int64_t memory = 0;       ///< that all arrays would take at once, bytes
    std::int64_t min_memory = 0;   ///< smallest budget that this volume can be built with
    std::int64_t budget = 0;       ///< of the environment, else BuildOptions::memory, or the default
    bool uses_scratch = false;     ///< arrays go to a scratch file
    std::int64_t disk = 0;         ///< for store, finished phases and scratch file together
    std::int64_t disk_free = 0;    ///< in the folder of the store
    std::int64_t store_bytes = 0;  ///< of the store
    double seconds = 0;
};

/// Reads a few slabs, or nothing where the file can only be read from its beginning: then it assumes noise. Throws Error{input}.
[[nodiscard]] BuildEstimate estimate_build(VolumeReader& reader, const std::string& path, const BuildOptions& options, int threads = 0);

/// Throws Error{resource} when the budget or the disk is too small, as build_atlas() would.
void check_estimate(const BuildEstimate& estimate, const std::string& volume_path, const std::string& path);

struct BuildReport {
    std::vector<std::string> resumed;  ///< phases that had been finished before
    /// Phases that had been finished and were made again, and why: "trees, zones of an earlier build are not used: spacing 1 x 1 x 1
    /// there, 2 x 2 x 2 here".
    std::vector<std::string> not_used;
    std::int64_t peak_memory = 0;  ///< peak of the resident memory of the process, bytes
    std::int64_t bytes = 0;        ///< of the store
    std::string left_behind;       ///< the folder of the build when it cannot be removed, though the store is complete; else ""
};

/// Analyses a volume and writes the store PATH; PATH appears when it is complete. The same volume and parameters give the same bytes,
/// for any memory, threads and interruptions. Throws Error: input (volume), resource (budget or disk too small, cannot be written, another
/// process builds PATH), cancelled (finished phases stay), usage (tunnel height). Cost: analyse(), a few passes over the samples.
BuildReport build_atlas(const std::string& path, VolumeReader& reader, const BuildOptions& options = {}, const Context& context = {});

/// The same for a volume in memory, without a budget.
/// A volume of negated samples (isoatlas/polarity.h) gives the store of its objects of low values, of the samples that are not negated.
BuildReport build_atlas(const std::string& path, const Volume& volume, const AnalysisOptions& options = {}, const Context& context = {},
                        PolarityChoice polarities = PolarityChoice::high);

class Atlas;

/// Differences in input and parameters of a store from those of build_atlas(volume, options): "spacing 1 x 1 x 1 there, 2 x 2 x 2 here",
/// one for each; empty: it is the store that this would write. compare_samples false: the samples are not read. Stores of versions 1 and 2
/// do not record which samples they were filtered or replaced from: that counts as a difference. Throws as VolumeReader::read(), cancelled.
/// Cost: nothing when the headers differ; else reads the volume once; memory: some slices.
[[nodiscard]] std::vector<std::string> store_differences(const Atlas& atlas, VolumeReader& volume, const BuildOptions& options,
                                                         bool compare_samples = true, const Context& context = {});
/// The same as one phrase; the first few of many.
[[nodiscard]] std::string joined_differences(const std::vector<std::string>& differences);

/// Progress of a build.
struct BuildState {
    std::string phase{};  ///< "classify", "pack", ...; empty: it has just begun
    int phase_index = 0, phase_count = 1;
    double fraction = 0;                        ///< of the whole build, 0 to 1: by the time that phases usually take
    std::optional<double> seconds_left{};       ///< of the whole build; empty: too early to estimate
    std::optional<double> voxels_per_second{};  ///< of this phase
    std::int64_t peak_memory = 0;               ///< of the process, bytes
    friend bool operator==(const BuildState&, const BuildState&) = default;
};

/// Computes states of a build from its progress reports.
class BuildClock {
public:
    [[nodiscard]] BuildState at(const Progress& progress);

private:
    using Clock = std::chrono::steady_clock;
    std::optional<Clock::time_point> start_{}, phase_start_{}, measured_{};
    std::int64_t peak_ = 0;                  ///< of the memory, when it was measured
    double first_ = 0, first_of_phase_ = 0;  ///< fractions that were reached before: finished phases take no time
    double furthest_ = 0;
    int phase_ = -1;
};

/// Progress of the build of the store PATH, as its process has reported within the last second. Empty: no process builds it. Never throws;
/// writes nothing.
[[nodiscard]] std::optional<BuildState> build_state(const std::string& path);

}  // namespace isoatlas
