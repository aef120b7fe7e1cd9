#include "page/histogram.h"

#include <algorithm>

namespace isoatlas::page {
namespace {

constexpr std::int64_t kBins = 160;
constexpr double kFew = 256;  // values

}  // namespace

Histogram make_histogram(const Volume& volume, const AxisScale& scale) {
    const bool each = !is_floating(volume.info.type) && scale.bend == 0 && scale.high - scale.low <= kFew;
    const std::int64_t bins = each ? static_cast<std::int64_t>(scale.high - scale.low) + 1 : kBins;
    Histogram histogram;
    for (std::int64_t i = 0; i <= bins; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(bins);
        histogram.edges.push_back(each ? scale.low - 0.5 + static_cast<double>(i) : scale.tau(part));
    }
    histogram.counts.assign(static_cast<std::size_t>(bins), 0);
    visit_samples(volume, [&](auto samples) {
        for (const auto sample : samples) {
            const auto value = static_cast<double>(sample);
            const double at = each ? value - scale.low : scale.position(value) * static_cast<double>(bins);
            ++histogram.counts[static_cast<std::size_t>(std::clamp<double>(at, 0, static_cast<double>(bins - 1)))];
        }
    });
    return histogram;
}

}  // namespace isoatlas::page
