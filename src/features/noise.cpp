#include "features/noise.h"

#include <algorithm>
#include <cmath>

#include "base/big_vector.h"
#include "base/streamed.h"
#include "field/sample_range.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kSamples = 1'000'000;

double at_fraction(BigVector<double>& values, double fraction) {
    if (values.empty()) return 0;
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

/// Every stride-th voxel, an odd stride so that no axis is favoured.
std::int64_t stride_for(std::int64_t voxels) { return std::max<std::int64_t>(1, voxels / kSamples) | 1; }

template <class T>
double second_differences(std::span<const T> samples, const Extent& extent) {
    BigVector<double> differences;
    differences.reserve(static_cast<std::size_t>(extent.voxels() / stride_for(extent.voxels()) + 1));
    const std::int64_t stride = stride_for(extent.voxels());
    for (const std::size_t k : streamed(count_by(1, extent.voxels() - 1, stride), {bytes_of_stride<T>(stride)})) {
        const std::int64_t i = 1 + static_cast<std::int64_t>(k) * stride;
        const std::int64_t x = i % extent.size[0];
        if (x == 0 || x + 1 == extent.size[0]) continue;
        differences.push_back(
            std::abs(static_cast<double>(samples[i - 1]) - 2 * static_cast<double>(samples[i]) + static_cast<double>(samples[i + 1])));
    }
    return at_fraction(differences, 0.5) / (0.6745 * std::sqrt(6.0));
}

template <class T>
double local_variance(std::span<const T> samples, const Extent& extent, std::int64_t i) {
    const Index3 p = extent.voxel(i);
    const Index3 low = max(p - 1, Index3{}), high = min(p + 1, extent.size - 1);
    double count = 0, mean = 0, squares = 0;
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
        for (std::int64_t y = low[1]; y <= high[1]; ++y) {
            for (std::int64_t x = low[0]; x <= high[0]; ++x) {  // Welford
                const double value = static_cast<double>(samples[extent.index(x, y, z)]);
                const double delta = value - mean;
                mean += delta / ++count;
                squares += delta * (value - mean);
            }
        }
    }
    return squares / count;
}

/// Are so many neighbourhoods constant, away from both ends of the range, that there can be no noise?
template <class T>
bool is_free_of_noise(std::span<const T> samples, const Extent& extent) {
    constexpr std::int64_t kFew = 50;
    const auto [low, high] = sample_range(samples);
    const std::int64_t stride = 8 * stride_for(extent.voxels()) | 1;
    std::int64_t constant = 0, all = 0;
    for (const std::size_t k : streamed(count_by(0, extent.voxels(), stride), {3 * bytes_of_stride<T>(stride)})) {  // of three slices
        const std::int64_t i = static_cast<std::int64_t>(k) * stride;
        const bool flat = local_variance(samples, extent, i) == 0;
        if (flat && (samples[i] == low || samples[i] == high)) continue;
        ++all;
        constant += flat;
    }
    return kFew * constant > all;
}

template <class T>
double quiet_places(std::span<const T> samples, const Extent& extent) {
    if (is_free_of_noise(samples, extent)) return 0;
    BigVector<double> variances;
    const std::int64_t stride = 8 * stride_for(extent.voxels()) | 1;
    for (const std::size_t k : streamed(count_by(0, extent.voxels(), stride), {3 * bytes_of_stride<T>(stride)})) {
        const std::int64_t i = static_cast<std::int64_t>(k) * stride;
        const double variance = local_variance(samples, extent, i);
        if (variance > 0) variances.push_back(variance);
    }
    return std::sqrt(at_fraction(variances, 0.2));
}

}  // namespace

double estimate_noise(const VolumeView& volume) {
    return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const double quantum = std::is_floating_point_v<T> ? 0 : 1 / std::sqrt(12.0);
        return std::max({second_differences(samples, volume.info->extent), quiet_places(samples, volume.info->extent), quantum});
    });
}

}  // namespace isoatlas
