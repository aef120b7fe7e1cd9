// A transfer function with its integrals: what a piece of a ray between two values sends out and swallows on average.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "isoatlas/render.h"
#include "render/vectors.h"

namespace isoatlas {

/// Extinction per unit of length, and the colour of what it swallows, weighted with it.
struct OpticalProperties {
    double extinction = 0;
    Vec3 glow{};  ///< extinction times colour
};

class Transfer {
public:
    /// length_unit: what the densities of bumps and curves are multiplied with. range: of the samples.
    Transfer(const SceneVolume& volume, double length_unit, std::array<double, 2> range);

    /// Where a value stands in the table: values outside of the range at its ends.
    [[nodiscard]] double place(double value) const {
        return std::clamp((value - low_) * places_per_value_, 0.0, static_cast<double>(kPlaces));
    }
    /// Mean between the places of two values, as where a value changes linearly from one to the other (Engel, Kraus, Ertl, 2001, without
    /// the attenuation inside of the piece). Exact to 1/4096 of the range.
    [[nodiscard]] OpticalProperties mean(double a, double b) const {
        const double low = std::min(a, b), high = std::max(a, b);
        if (high < next_visible_[static_cast<std::int64_t>(low)]) return {};
        return mean_between(low, high);
    }
    /// Is any mean between values from low to high more than nothing?
    [[nodiscard]] bool visible(double low, double high) const {
        return next_visible_[static_cast<std::int64_t>(std::max(0.0, place(low) - kWidening))] <= place(high) + kWidening;
    }
    static constexpr std::int64_t kPlaces = 4096;

private:
    static constexpr double kWidening = 0.5;  ///< places, of means between values too close to each other
    using Sums = std::array<double, 4>;       ///< extinction, glow
    void add(const TransferCurve& curve, double length_unit);
    [[nodiscard]] OpticalProperties mean_between(double low, double high) const;

    double low_, places_per_value_;
    std::vector<double> next_visible_;  ///< of every place: the first one at or after it that something lies between it and the next
    std::vector<Sums> sums_;            ///< integrals over the values from the lowest one to each of evenly spaced ones
};

}  // namespace isoatlas
