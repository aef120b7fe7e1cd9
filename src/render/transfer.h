// A transfer function with its integrals: what a piece of a ray between two values sends out and swallows on average.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "isoatlas/render.h"
#include "render/vectors.h"

namespace isoatlas::render {

/// Extinction per unit of length, and the colour of what it swallows, weighted with it.
struct Matter {
    double extinction = 0;
    Vec3 glow{};  ///< extinction times colour
};

class Transfer {
public:
    /// bumps: stored values. length_unit: how many units of the caller's length are one unit of the bumps' densities. range: of the
    /// samples.
    Transfer(std::span<const TransferBump> bumps, double length_unit, std::array<double, 2> range);

    /// Mean over the values between a and b, as where a value changes linearly from a to b (Engel, Kraus, Ertl, 2001, without the
    /// attenuation inside of the piece). Exact to 1/4096 of the range.
    [[nodiscard]] Matter mean(double a, double b) const;
    /// Is there anything between two values, low <= high?
    [[nodiscard]] bool visible(double low, double high) const;

private:
    using Sums = std::array<double, 4>;  ///< extinction, glow
    [[nodiscard]] Sums sums_to(double place) const;

    double low_, places_per_value_;
    std::vector<Sums> sums_;  ///< integrals over the values from the lowest one to each of evenly spaced ones
    struct Range {
        double low, high;
    };
    std::vector<Range> visible_;
};

}  // namespace isoatlas::render
