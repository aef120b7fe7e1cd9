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
    /// bumps: stored values. length_unit: how many units of the caller's length are one unit of the bumps' densities.
    Transfer(std::span<const TransferBump> bumps, double length_unit);

    /// Mean over the values between a and b, as where a value changes linearly from a to b. Cost: O(bumps).
    [[nodiscard]] Matter mean(double a, double b) const;
    /// Is there anything between two values, low <= high?
    [[nodiscard]] bool visible(double low, double high) const;

private:
    struct Part {
        double low, rise, fall, high, density;  ///< a trapezoid with these corners
        Vec3 colour;
        [[nodiscard]] double at(double value) const;
        [[nodiscard]] double integral(double value) const;  ///< from -infinity
    };
    std::vector<Part> parts_;
};

}  // namespace isoatlas::render
