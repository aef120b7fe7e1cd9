// Counts for isoatlas/survey.h, from rows of samples in any number of parts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "isoatlas/survey.h"

namespace isoatlas {

class SampleCounter {
public:
    /// Adds a row of samples along x. Cost: O(row), a look-up for each run of equal samples while there are few different ones.
    template <class T>
    void look(std::span<const T> row);

    [[nodiscard]] SampleSurvey survey() const;

private:
    static constexpr std::size_t kMost = SampleSurvey::kMostValues, kUnknown = kMost + 1;
    static constexpr std::array<std::size_t, 256> unknown_bytes() {
        std::array<std::size_t, 256> all{};
        all.fill(kUnknown);
        return all;
    }
    struct Value {
        double value;
        std::int64_t count = 0, pairs = 0;
    };

    /// Which value it is, by order of appearance; kMost: there are too many different ones.
    std::size_t place_of(double value);
    /// The same for samples of a byte, without a search where it is known.
    std::size_t place_of_byte(double value, std::uint8_t byte) {
        std::size_t& known = of_byte_[byte];
        if (known == kUnknown) known = place_of(value);
        return known;
    }
    void count_run(std::size_t place, std::int64_t length) {
        values_[place].count += length;
        values_[place].pairs += length - 1;
        pairs_ += length - 1;
    }
    void look_at_end(double value, std::int64_t length);

    SampleSurvey ends_;  ///< samples, missing, low, high
    bool has_few_ = true;
    std::vector<Value> values_;           ///< in order of appearance
    std::vector<std::size_t> ascending_;  ///< of values_
    std::size_t last_ = 0;                ///< of values_: runs often alternate
    std::array<std::size_t, 256> of_byte_ = unknown_bytes();
    std::int64_t pairs_ = 0;
    std::vector<std::int64_t> unequal_;  ///< [i * kMost + j]: pairs of neighbours, i appears first
};

template <class T>
void SampleCounter::look(std::span<const T> row) {
    std::size_t before = kMost;
    for (std::size_t i = 0; i < row.size();) {
        const T sample = row[i];
        if constexpr (std::is_floating_point_v<T>) {
            if (!std::isfinite(sample)) {
                ++ends_.missing, ++i, before = kMost;
                continue;
            }
        }
        std::size_t end = i + 1;
        while (end < row.size() && row[end] == sample) ++end;
        const auto length = static_cast<std::int64_t>(end - i);
        look_at_end(static_cast<double>(sample), length);
        if (has_few_) {
            std::size_t at = 0;
            if constexpr (sizeof(T) == 1) {
                at = place_of_byte(static_cast<double>(sample), static_cast<std::uint8_t>(sample));
            } else {
                at = place_of(static_cast<double>(sample));
            }
            if (at < kMost) count_run(at, length);
            if (before < kMost && at < kMost) ++pairs_, ++unequal_[std::min(before, at) * kMost + std::max(before, at)];
            before = at;
        }
        i = end;
    }
}

inline void SampleCounter::look_at_end(double value, std::int64_t length) {
    ends_.samples += length;
    RangeEnd &low = ends_.low, &high = ends_.high;
    if (value <= low.next) {
        if (value < low.value) {
            low = {value, length, low.value};
        } else if (value == low.value) {
            low.count += length;
        } else {
            low.next = value;
        }
    }
    if (value >= high.next) {
        if (value > high.value) {
            high = {value, length, high.value};
        } else if (value == high.value) {
            high.count += length;
        } else {
            high.next = value;
        }
    }
}

/// All samples of a volume. Cost: O(volume).
template <class T>
[[nodiscard]] SampleSurvey survey_of(std::span<const T> samples, const Extent& extent) {
    SampleCounter counter;
    for (std::int64_t first = 0; first < extent.voxels(); first += extent.size[0])
        counter.look(samples.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(extent.size[0])));
    return counter.survey();
}

}  // namespace isoatlas
