#include "page/axis_scale.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace isoatlas::page {

AxisScale axis_scale(const Atlas& atlas, const Context& context) {
    constexpr int kOctaves = 20, kSteps = 8;  // edges at the range / 2^(k/8)
    const auto [low, high] = atlas.range();
    AxisScale scale{low, high, 0};
    const double range = high - low;
    if (!(range > 0) || !std::isfinite(range)) return scale;
    std::vector<double> above;
    for (int k = kOctaves * kSteps; k >= 0; --k) above.push_back(range * std::exp2(-static_cast<double>(k) / kSteps));
    above.back() = range;
    std::vector<double> edges(above);
    for (double& edge : edges) edge += low;
    edges.back() = high;
    const std::vector<std::int64_t> counts = atlas.histogram(edges, context);
    const auto all = static_cast<double>(std::reduce(counts.begin(), counts.end()));
    double seen = 0, in_lowest_tenth = 0, median = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        seen += static_cast<double>(counts[i]);
        if (above[i + 1] <= range / 10) in_lowest_tenth = seen;
        if (median == 0 && seen >= all / 2) median = above[i + 1];
    }
    if (all > 0 && in_lowest_tenth >= 0.95 * all) scale.bend = median;
    return scale;
}

}  // namespace isoatlas::page
