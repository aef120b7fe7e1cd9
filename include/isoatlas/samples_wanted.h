// The samples of a store to be read.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isoatlas/filter.h"

namespace isoatlas {

/// The samples that a picture needs.
struct SamplesWanted {
    static constexpr std::int64_t kAround = 7;  ///< samples
    /// The corners of cells with a value in one of these ranges, and samples up to kAround away.
    std::vector<std::array<double, 2>> values{};
    std::vector<SampleBox> boxes{};  ///< all in these, clipped to the volume
};

}  // namespace isoatlas
