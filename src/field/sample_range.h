// All samples, or some of them, read in order while memory is limited.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "base/streamed.h"

namespace isoatlas {

/// Bytes that a step brings into memory when every stride-th sample is read.
template <class T>
[[nodiscard]] std::size_t bytes_of_stride(std::int64_t stride) {
    return std::min(static_cast<std::size_t>(stride) * sizeof(T), at_random().bytes);
}

/// Minimum and maximum of the samples; there is at least one.
template <class T>
[[nodiscard]] std::pair<T, T> sample_range(std::span<const T> samples) {
    constexpr std::size_t kTogether = std::size_t{1} << 13;
    std::pair<T, T> range{samples.front(), samples.front()};
    for (const std::size_t part : streamed((samples.size() + kTogether - 1) / kTogether, StepBytes{kTogether * sizeof(T)})) {
        const std::span<const T> rest = samples.subspan(part * kTogether), some = rest.first(std::min(kTogether, rest.size()));
        const auto [low, high] = std::ranges::minmax(some);
        range = {std::min(range.first, low), std::max(range.second, high)};
    }
    return range;
}

}  // namespace isoatlas
