#include "catalogue/histogram.h"

#include <algorithm>
#include <span>

#include "atlas/access.h"
#include "census/level_census.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBins = 160;
constexpr double kFew = 256;        // values
constexpr double kCensusSteps = 4;  // of the census in the narrowest bin

/// Moves the edges between the ends to the closest values of the census, unless that is too coarse for them.
void move_to_counted(const Atlas& atlas, std::span<double> edges) {
    const std::vector<double>& values = AtlasAccess::census(atlas).value;
    if (values.size() < 2) return;
    double narrowest = edges.back() - edges.front();
    for (std::size_t i = 1; i < edges.size(); ++i) narrowest = std::min(narrowest, edges[i] - edges[i - 1]);
    const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
    if (narrowest < kCensusSteps * step) return;
    for (double& edge : edges.subspan(1, edges.size() - 2)) {
        const auto after = std::ranges::lower_bound(values, edge);
        if (after == values.begin() || after == values.end()) continue;
        edge = edge - after[-1] < *after - edge ? after[-1] : *after;
    }
}

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
    if (!each) move_to_counted(atlas, histogram.edges);
    const std::vector<Bounds> at_least = samples_of_at_least(atlas, histogram.edges);
    if (!std::ranges::all_of(at_least, [](const Bounds& bounds) { return bounds.min == bounds.max; })) {
        histogram.counts = atlas.histogram(histogram.edges, context);
        return histogram;
    }
    for (std::size_t i = 0; i + 1 < at_least.size(); ++i) {
        const bool is_last = i + 2 == at_least.size();  // it has its end, the highest sample, too
        histogram.counts.push_back(at_least[i].min - (is_last ? 0 : at_least[i + 1].min));
    }
    return histogram;
}

}  // namespace isoatlas
