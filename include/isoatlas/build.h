// Building a store from a volume of any size, within a memory budget, in phases that survive a crash.
//
// Phases: trees (critical elements, criticality tree, contour tree), zones (their sizes), pack (bricks and trees into one file). What a
// finished phase has found lies in the folder PATH.build, written, synced and renamed, until the store is there; a second build of the
// same volume with the same parameters goes on behind it. Anybody can ask where a build is: build_state().
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/context.h"
#include "isoatlas/volume.h"

namespace isoatlas {

struct BuildOptions {
    AnalysisOptions analysis{};          ///< zones: of no meaning here
    MissingPolicy missing{};             ///< as load_volume()
    std::optional<Geometry> geometry{};  ///< instead of that of the file
    /// Instead of analysis.tunnel_height: percent of the range of the samples that are analysed, filtered ones included; 0: off.
    double tunnel_height_percent = 0;
    double gaussian = 0;      ///< filters the samples first: sigma as of gaussian_filter(); 0: off
    std::int64_t memory = 0;  ///< bytes for the whole process, 64 MiB or more; 0: half of what the machine or its control group has
    bool restart = false;     ///< forgets finished phases
};

/// What a build will take; critical elements are counted in a few slabs of the volume.
struct BuildEstimate {
    std::int64_t critical_elements = 0;
    std::int64_t memory = 0;        ///< that all arrays would take at once, bytes
    std::int64_t memory_least = 0;  ///< smallest budget that this volume can be built with
    std::int64_t budget = 0;        ///< BuildOptions::memory, or the default
    bool uses_scratch = false;      ///< arrays go to a scratch file
    std::int64_t disk = 0;          ///< for store, finished phases and scratch file together
    std::int64_t disk_free = 0;     ///< in the folder of the store
    std::int64_t store_bytes = 0;   ///< of the store
    double seconds = 0;
};

/// Reads a few slabs, or nothing where the file can only be read from its beginning: then it assumes noise. Throws Error{input}.
[[nodiscard]] BuildEstimate estimate_build(VolumeReader& reader, const std::string& path, const BuildOptions& options, int threads = 0);

/// Throws Error{resource} when the budget or the disk is too small, as build_atlas() would.
void check_estimate(const BuildEstimate& estimate, const std::string& volume_path, const std::string& path);

struct BuildReport {
    std::vector<std::string> resumed;  ///< phases that had been finished before
    std::int64_t peak_memory = 0;      ///< most resident memory of the process, bytes
    std::int64_t bytes = 0;            ///< of the store
    std::string left_behind;           ///< the folder of the build when it cannot be removed, though the store is complete; else ""
};

/// Analyses a volume and writes the store PATH; PATH appears when it is complete. The same volume and parameters give the same bytes,
/// for any memory, threads and interruptions. Throws Error: input (volume), resource (budget or disk too small, cannot be written, another
/// process builds PATH), cancelled (finished phases stay), usage (tunnel height). Cost: analyse(), a few passes over the samples.
BuildReport build_atlas(const std::string& path, VolumeReader& reader, const BuildOptions& options = {}, const Context& context = {});

/// The same for a volume in memory, without a budget.
BuildReport build_atlas(const std::string& path, const Volume& volume, const AnalysisOptions& options = {}, const Context& context = {});

/// Where a build is, for those who wait for its store.
struct BuildState {
    std::string phase{};  ///< "classify", "pack", ...; empty: it has only begun
    int phase_index = 0, phase_count = 1;
    double fraction = 0;                        ///< of the whole build, 0 to 1: by the time that phases usually take
    std::optional<double> seconds_left{};       ///< of the whole build; nothing: too early to tell
    std::optional<double> voxels_per_second{};  ///< of this phase
    std::int64_t peak_memory = 0;               ///< of the process, bytes
    friend bool operator==(const BuildState&, const BuildState&) = default;
};

/// Makes states of what a build tells its Context.
class BuildClock {
public:
    [[nodiscard]] BuildState at(const Progress& progress);

private:
    using Clock = std::chrono::steady_clock;
    std::optional<Clock::time_point> start_{}, phase_start_{};
    double first_ = 0, first_of_phase_ = 0;  ///< fractions that were reached before: finished phases take no time
    double furthest_ = 0;
    int phase_ = -1;
};

/// Where the build of the store PATH is, as the process that builds it has said within the last second. Nothing: nobody builds it. Never
/// throws; writes nothing.
[[nodiscard]] std::optional<BuildState> build_state(const std::string& path);

}  // namespace isoatlas
