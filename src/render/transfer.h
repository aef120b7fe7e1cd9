// A pre-integrated transfer function: mean emission and extinction of a ray segment between two values.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "isoatlas/render.h"
#include "render/vectors.h"

namespace isoatlas {

/// Extinction per unit of length, and its colour, weighted by extinction.
struct OpticalProperties {
    double extinction = 0;
    Vec3 glow{};  ///< extinction times colour
};

class Transfer {
public:
    /// length_unit: factor of the densities of tents and curves. range: of the samples.
    Transfer(const SceneVolume& volume, double length_unit, std::array<double, 2> range);

    /// Table position of a value; values outside of the range are clamped.
    [[nodiscard]] double place(double value) const {
        return std::clamp((value - low_) * places_per_value_, 0.0, static_cast<double>(kPlaces));
    }
    /// What place() does to a value: it is less `zero`, times `factor`, at least 0 and at most `last`.
    struct Scale {
        double zero, factor, last;
    };
    [[nodiscard]] Scale scale() const { return {low_, places_per_value_, static_cast<double>(kPlaces)}; }
    /// Mean between two table positions, for a value that changes linearly between them (Engel, Kraus, Ertl, 2001, without attenuation
    /// within the segment). Exact to 1/4096 of the range.
    [[nodiscard]] OpticalProperties mean(double a, double b) const {
        const double low = std::min(a, b), high = std::max(a, b);
        if (high < static_cast<double>(next_visible_[static_cast<std::int64_t>(low)])) return {};
        return mean_between(low, high);
    }
    /// Bit i: is the mean between places i and i + 1 above 0? Of table positions.
    template <std::size_t kCount>
    [[nodiscard]] unsigned visible_between(const std::array<float, kCount>& places) const {
        unsigned bits = 0;
        for (std::size_t i = 0; i + 1 < kCount; ++i) {
            const float low = std::min(places[i], places[i + 1]), high = std::max(places[i], places[i + 1]);
            bits |= (high < static_cast<float>(next_visible_[static_cast<std::int32_t>(low)]) ? 0U : 1U) << i;
        }
        return bits;
    }
    /// Is any mean between values from low to high above 0?
    [[nodiscard]] bool visible(double low, double high) const {
        const auto from = static_cast<std::int64_t>(std::max(0.0, place(low) - kWidening));
        return static_cast<double>(next_visible_[from]) <= place(high) + kWidening;
    }
    static constexpr std::int64_t kPlaces = 4096;

private:
    static constexpr double kWidening = 0.5;  ///< table positions averaged for values too close to each other
    using Sums = std::array<double, 4>;       ///< extinction, glow
    void add(const TransferCurve& curve, double length_unit);
    [[nodiscard]] OpticalProperties mean_between(double low, double high) const {
        // Closer than one table entry, differences of the sums would be lost in rounding: then averages over neighbouring entries.
        if (high - low < 1e-3) {
            low = std::max(0.0, low - kWidening);
            high = std::min(high + kWidening, static_cast<double>(kPlaces));
        }
        const auto i = std::min(static_cast<std::int64_t>(low), kPlaces - 1), j = std::min(static_cast<std::int64_t>(high), kPlaces - 1);
        const double f = low - static_cast<double>(i), g = high - static_cast<double>(j), part = places_per_value_ / (high - low);
        const Sums &from = sums_[i], &from_next = sums_[i + 1], &to = sums_[j], &to_next = sums_[j + 1];
        Sums mean;
        for (int c = 0; c < 4; ++c) mean[c] = part * ((to[c] + g * (to_next[c] - to[c])) - (from[c] + f * (from_next[c] - from[c])));
        return {mean[0], {mean[1], mean[2], mean[3]}};
    }

    double low_, places_per_value_;
    std::vector<std::uint16_t> next_visible_;  ///< per position: the first one at or after it with visible values before the next one
    std::vector<Sums> sums_;                   ///< integrals from the lowest value to each of evenly spaced ones
};

}  // namespace isoatlas
