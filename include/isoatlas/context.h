// Context: resources, progress reports and cancellation of a long call. Passed by reference, never stored.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace isoatlas {

struct Environment;

struct Progress {
    std::string_view phase;  ///< "classify", "join tree", ...
    int phase_index = 0;     ///< 0-based
    int phase_count = 1;
    double fraction = 0;      ///< of this phase, 0..1
    std::int64_t voxels = 0;  ///< that the phase processes; 0: unknown
};

/// Defaults: all processors, no progress, never cancelled, the environment of the calling thread.
/// The results of every function are the same bytes for any value of threads and slab_slices.
struct Context {
    int threads = 0;                                  ///< 0: those of the environment, else one per processor
    std::int64_t slab_slices = 0;                     ///< slices (last axis) per slab; 0: chosen for the thread count
    std::function<void(const Progress&)> progress{};  ///< called from the calling thread only; may be empty
    std::function<bool()> cancelled{};                ///< polled between slabs; true: Error{cancelled} is thrown
    /// Files, memory budget and threads of the call (environment.h); null: those of the calling thread.
    const Environment* environment = nullptr;

    void report(std::string_view phase, int index, int count, double fraction) const {
        if (progress) progress({phase, index, count, fraction});
    }
};

}  // namespace isoatlas
