// A volume as it is and smoothed, at one isovalue, side by side.
#pragma once

#include <cstdint>
#include <optional>

#include "catalogue/turntable.h"
#include "isoatlas/atlas.h"

namespace isoatlas {

/// Everything at the isovalue.
struct ShownSmoothing {
    std::int64_t objects = 0, tunnels = 0;  ///< all of them
    Turntable picture{};                    ///< one frame
};

struct SmoothingComparison {
    double tau = 0;  ///< stored value
    ShownSmoothing as_is, smooth;
};

/// At the best isovalue of the first object that is more than background. sigma: of the filter. None: there is no object, or the samples
/// take more than 512 MiB. Throws Error: input (damaged store), cancelled. Cost: reads all samples and filters them, cuts and draws both.
[[nodiscard]] std::optional<SmoothingComparison> compare_smoothing(const Atlas& atlas, double sigma, const PageOptions& options,
                                                                   const Context& context);

}  // namespace isoatlas
