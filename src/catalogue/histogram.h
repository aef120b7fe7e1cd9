// Histogram of the samples.
#pragma once

#include <cstdint>
#include <vector>

#include "catalogue/page_axis.h"
#include "isoatlas/atlas.h"

namespace isoatlas {

struct Histogram {
    std::vector<double> edges;         ///< ascending
    std::vector<std::int64_t> counts;  ///< one fewer, as in Atlas::histogram()
};

/// Integers of a range of at most 256 have a bin for every value, else there are 160 bins, equally wide on the axis but for the steps of
/// the census of the store: edges lie at the closest values that it counts. Cost: as page_axis().
[[nodiscard]] Histogram make_histogram(const Atlas& atlas, const AxisScale& scale, const Context& context = {});

}  // namespace isoatlas
