#include "catalogue/histogram.h"

#include <algorithm>

namespace isoatlas {
namespace {

constexpr std::int64_t kBins = 160;
constexpr double kFew = 256;  // values

}  // namespace

Histogram make_histogram(const Atlas& atlas, const AxisScale& scale, const Context& context) {
    const bool each = !is_floating(atlas.info().type) && scale.bend == 0 && scale.high - scale.low <= kFew;
    const std::int64_t bins = each ? static_cast<std::int64_t>(scale.high - scale.low) + 1 : kBins;
    Histogram histogram;
    for (std::int64_t i = 0; i <= bins; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(bins);
        histogram.edges.push_back(each ? scale.low - 0.5 + static_cast<double>(i) : scale.tau(part));
    }
    // Rounding of the axis scale must not lose the first and the last sample.
    histogram.edges.front() = std::min(histogram.edges.front(), scale.low);
    histogram.edges.back() = std::max(histogram.edges.back(), scale.high);
    histogram.counts = atlas.histogram(histogram.edges, context);
    return histogram;
}

}  // namespace isoatlas
