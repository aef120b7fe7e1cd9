#include "features/stable_isovalue.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isoatlas {
namespace {

/// Gaussian of 2 bins; the ends repeat.
std::vector<double> smooth(const std::vector<double>& values) {
    constexpr int kReach = 6;
    std::array<double, 2 * kReach + 1> weight{};
    double total = 0;
    for (int k = -kReach; k <= kReach; ++k) total += weight[k + kReach] = std::exp(-k * k / 8.0);
    const auto n = static_cast<std::ptrdiff_t>(values.size());
    std::vector<double> result(values.size(), 0);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        for (int k = -kReach; k <= kReach; ++k)
            result[i] += weight[k + kReach] / total * values[std::clamp<std::ptrdiff_t>(i + k, 0, n - 1)];
    }
    return result;
}

/// Height of the peak at i above the higher of the two valleys that part it from higher peaks.
double prominence(const std::vector<double>& s, std::size_t i) {
    const auto valley = [&](int step) {
        double low = s[i];
        for (std::ptrdiff_t k = static_cast<std::ptrdiff_t>(i) + step;; k += step) {
            if (k < 0 || k >= static_cast<std::ptrdiff_t>(s.size()))
                return -std::numeric_limits<double>::infinity();  // no higher peak there
            if (s[k] > s[i]) return low;
            low = std::min(low, s[k]);
        }
    };
    return s[i] - std::max(valley(-1), valley(1));
}

/// Are the voxels that join around a peak significantly fewer than after its valley? Counts vary as their square roots.
bool is_significant(double stability, double prominence, double volume) {
    if (!std::isfinite(prominence)) return true;
    const double peak = std::exp(-stability) * volume * kSmoothedBins, valley = peak * std::exp(prominence);
    return valley - peak >= 3 * std::sqrt(valley + peak);
}

}  // namespace

std::vector<StableIsovalue> stable_isovalues(std::span<const double> added, double low, double high) {
    const std::size_t bins = added.size();
    std::vector<double> log_volume(bins);
    std::vector<double> volume(added.begin(), added.end());
    for (std::size_t i = bins; i-- > 0;) {
        if (i + 1 < bins) volume[i] += volume[i + 1];
        log_volume[i] = std::log(std::max(volume[i], 0.5));
    }
    log_volume = smooth(log_volume);
    std::vector<double> stability;  // -ln q between neighbouring bins
    for (std::size_t i = 0; i + 1 < bins; ++i) stability.push_back(-std::log(std::max(log_volume[i] - log_volume[i + 1], 1e-6)));
    std::vector<StableIsovalue> peaks;
    const double width = (high - low) / static_cast<double>(bins);
    for (std::size_t i = 1; i + 1 < stability.size(); ++i) {
        if (!(stability[i] > stability[i - 1] && stability[i] >= stability[i + 1])) continue;
        std::size_t last = i;  // a flat top: take its middle
        while (last + 2 < stability.size() && stability[last + 1] == stability[i]) ++last;
        const double height = prominence(stability, i);
        if (height < std::log(1.5)) continue;
        const double edge = static_cast<double>(i + last) / 2 + 1;
        const double there = volume[static_cast<std::size_t>(edge)];
        if (is_significant(stability[i], height, there)) peaks.push_back({low + edge * width, height, there, edge <= 3});
    }
    std::stable_sort(peaks.begin(), peaks.end(), [](const auto& p, const auto& q) { return p.prominence > q.prominence; });
    return peaks;
}

std::vector<StableIsovalue> stable_isovalues(const BranchHistogram& histogram) {
    std::vector<StableIsovalue> peaks = stable_isovalues(histogram.added, histogram.low, histogram.high);
    for (StableIsovalue& peak : peaks) peak.tau = histogram.axis.height(peak.tau);
    return peaks;
}

}  // namespace isoatlas
