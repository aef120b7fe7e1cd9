// Selection: which objects are kept. The tree is not changed.
#pragma once

#include <cstdint>
#include <optional>

namespace isoatlas {

/// All conditions given must hold; none given: every object is kept. The main branch, the object that exists at every isovalue, is always
/// kept. Every size grows towards the main branch, so with an object all that it merges into are kept.
struct Selection {
    std::optional<std::int64_t> keep{};   ///< the first so many by rank (hypervolume), the main branch included
    std::optional<double> top_percent{};  ///< the first so many percent of all objects by rank, rounded up
    double min_voxels = 0;                ///< of the object just before it merges
    double min_measure = 0;               ///< its physical volume (area in 2D)
    double min_persistence = 0;           ///< difference of stored values between its highest sample and the value where it merges
    double min_hypervolume = 0;           ///< stored values times voxels
};

}  // namespace isoatlas
