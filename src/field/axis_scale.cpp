#include "field/axis_scale.h"

#include <algorithm>
#include <numeric>

#include "base/streamed.h"
#include "field/sample_range.h"

namespace isoatlas {
namespace {

constexpr int kOctaves = 20, kSteps = 8;  // edges at the range / 2^(k/8)
constexpr std::int64_t kSamples = std::int64_t{1} << 20;

/// Distances of the edges from the low end, but for that of the low end itself.
double edge_above(double range, std::size_t edge) {
    return range * std::exp2(-static_cast<double>(kOctaves * kSteps - static_cast<int>(edge)) / kSteps);
}

}  // namespace

std::vector<double> axis_edges(double low, double high) {
    const double range = high - low;
    if (!(range > 0) || !std::isfinite(range)) return {};
    std::vector<double> edges;
    for (std::size_t i = 0; i <= kOctaves * kSteps; ++i) edges.push_back(low + edge_above(range, i));
    edges.back() = high;
    return edges;
}

AxisScale axis_scale(double low, double high, std::span<const std::int64_t> counts) {
    AxisScale scale{low, high, 0};
    const double range = high - low;
    const auto all = static_cast<double>(std::reduce(counts.begin(), counts.end()));
    double seen = 0, in_lowest_tenth = 0, median = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        seen += static_cast<double>(counts[i]);
        const double above = edge_above(range, i + 1);
        if (above <= range / 10) in_lowest_tenth = seen;
        if (median == 0 && seen >= all / 2) median = above;
    }
    if (all > 0 && in_lowest_tenth >= 0.95 * all) scale.bend = median;
    return scale;
}

std::optional<AxisScale> axis_scale(double low, double high, std::span<const Bounds> at_least) {
    if (at_least.empty()) return AxisScale{low, high, 0};
    const double range = high - low;
    std::size_t tenth = 0;
    while (tenth + 1 < at_least.size() && edge_above(range, tenth + 1) <= range / 10) ++tenth;
    // With n samples above the first edge: bent where at most n / 20 are beyond the tenth, then at the first edge with at most n / 2
    // beyond.
    constexpr double kFew = 0.05, kSlack = 1e-9;  // the slack: for rounding
    const auto surely = [&](std::size_t edge, double part) {
        return static_cast<double>(at_least[edge].max) <= (part - kSlack) * static_cast<double>(at_least[0].min);
    };
    const auto maybe = [&](std::size_t edge, double part) {
        return static_cast<double>(at_least[edge].min) <= (part + kSlack) * static_cast<double>(at_least[0].max);
    };
    if (!maybe(tenth, kFew)) return AxisScale{low, high, 0};
    if (!surely(tenth, kFew)) return std::nullopt;
    for (std::size_t i = 1; i < at_least.size(); ++i) {
        if (surely(i, 0.5)) return AxisScale{low, high, edge_above(range, i)};
        if (maybe(i, 0.5)) return std::nullopt;
    }
    return std::nullopt;
}

AxisScale axis_scale(const VolumeView& volume) {
    return visit_samples(volume, [](auto samples) {
        const auto [min, max] = sample_range(samples);
        const auto low = static_cast<double>(min), high = static_cast<double>(max);
        const std::vector<double> edges = axis_edges(low, high);
        std::vector<std::int64_t> counts(edges.empty() ? 0 : edges.size() - 1, 0);
        if (counts.empty()) return AxisScale{low, high, 0};
        const std::size_t stride = std::max<std::size_t>(1, samples.size() / kSamples) | 1;
        const StepBytes step{bytes_of_stride<decltype(min)>(static_cast<std::int64_t>(stride))};
        for (const std::size_t i : streamed((samples.size() + stride - 1) / stride, step)) {
            const auto sample = static_cast<double>(samples[i * stride]);
            if (sample < edges.front()) continue;
            const auto after = static_cast<std::size_t>(std::ranges::upper_bound(edges, sample) - edges.begin());
            ++counts[std::min(after - 1, counts.size() - 1)];
        }
        return axis_scale(low, high, counts);
    });
}

}  // namespace isoatlas
