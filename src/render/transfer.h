// A pre-integrated transfer function: mean emission and extinction of a ray segment between two values.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/render.h"
#include "render/ray_segments.h"
#include "render/vectors.h"

namespace isoatlas {

/// Extinction per unit of length, and its colour, weighted by extinction.
struct OpticalProperties {
    double extinction = 0;
    Vec3 glow{};  ///< extinction times colour
};

/// What ray segments do to light by themselves.
struct SegmentLights {
    std::array<double, kLanes> opacity;
    std::array<FourDoubles, kLanes> colour;  ///< the first is 1, then red, green, blue
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
    /// Mean between two table positions, 0 to kPlaces, for a value that changes linearly between them (Engel, Kraus, Ertl, 2001, without
    /// attenuation within the segment). Exact to 1/4096 of the range.
    [[nodiscard]] OpticalProperties mean(double a, double b) const;
    /// What segments do, from mean() and their lengths. Bit i: segment i swallows light, and `found` has it.
    [[nodiscard]] unsigned lights(const SegmentEnds& ends, SegmentLights& found) const;
    /// Is any mean between values from low to high above 0?
    [[nodiscard]] bool visible(double low, double high) const {
        const auto from = static_cast<std::int64_t>(std::max(0.0, place(low) - kWidening));
        return static_cast<double>(next_visible_[from]) <= place(high) + kWidening;
    }
    static constexpr std::int64_t kPlaces = 4096;

private:
    static constexpr double kWidening = 0.5;  ///< table positions averaged for values too close to each other
    using Sums = std::array<double, 4>;       ///< extinction, glow
    /// Integrals to `part` of the way from an entry to the next one.
    void sums_at(std::int32_t entry, double part, FourDoubles& sums) const;
    void mean_between(double low, double high, FourDoubles& mean) const;
    /// Bit i: there is something visible between the i-th entries, or in one of them.
    [[nodiscard]] unsigned visible_between(const EightIntegers& first, const EightIntegers& second) const;
    void add(const TransferCurve& curve, double length_unit);
    double low_, places_per_value_;
    std::vector<std::uint16_t> next_visible_;  ///< per position: the first one at or after it with visible values before the next one
    std::vector<Sums> sums_;                   ///< integrals from the lowest value to each of evenly spaced ones; the last one twice
};

}  // namespace isoatlas
