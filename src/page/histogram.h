// How many samples have which value.
#pragma once

#include <cstdint>
#include <vector>

#include "isoatlas/volume.h"
#include "page/axis_scale.h"

namespace isoatlas::page {

struct Histogram {
    std::vector<double> edges;         ///< ascending
    std::vector<std::int64_t> counts;  ///< one less: of the samples in [edge, next edge)
};

/// Integers of a range of at most 256 have a bin for every value, else there are 160 bins, equally wide on the axis. Cost: O(samples).
[[nodiscard]] Histogram make_histogram(const Volume& volume, const AxisScale& scale);

}  // namespace isoatlas::page
