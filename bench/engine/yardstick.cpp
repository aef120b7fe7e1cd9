#include "yardstick.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>
#include <vector>

namespace bench {
namespace {

using Clock = std::chrono::steady_clock;

template <class T>
bool is_maximum(std::span<const T> samples, const isoatlas::Extent& extent, std::int64_t index) {
    const isoatlas::Index3 voxel = extent.voxel(index);
    const std::array<std::int64_t, 3> step{1, extent.size[0], extent.slice()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const T value = samples[static_cast<std::size_t>(index)];
        if (voxel[axis] > 0 && samples[static_cast<std::size_t>(index - step[axis])] > value) return false;
        if (voxel[axis] + 1 < extent.size[axis] && samples[static_cast<std::size_t>(index + step[axis])] >= value) return false;
    }
    return true;
}

}  // namespace

double seconds_of_sort(const isoatlas::Volume& volume) {
    return isoatlas::visit_samples(volume, [](auto samples) {
        using T = typename decltype(samples)::value_type;
        std::vector<std::pair<T, std::uint32_t>> pairs(samples.size());
        for (std::size_t i = 0; i < samples.size(); ++i) pairs[i] = {samples[i], static_cast<std::uint32_t>(i)};
        const Clock::time_point start = Clock::now();
        std::sort(pairs.begin(), pairs.end());
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (!std::is_sorted(pairs.begin(), pairs.end())) throw std::runtime_error("std::sort did not sort");
        return seconds;
    });
}

std::int64_t count_maxima(const isoatlas::Volume& volume) {
    return isoatlas::visit_samples(volume, [&volume](auto samples) {
        using T = std::remove_const_t<typename decltype(samples)::element_type>;
        std::int64_t count = 0;
        for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i) count += is_maximum<T>(samples, volume.info.extent, i) ? 1 : 0;
        return count;
    });
}

}  // namespace bench
