// How the value of a saddle becomes a double: rounded once, downwards.
//
// The value of an element is the greatest double at most the exact one. So "value >= tau" is true exactly when "exact value >= tau" is, for
// every isovalue tau there is (docs/theory/1-elements-and-order.md#numbers). Rounding to nearest could lift a saddle to a sample above it.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <optional>

#include "field/error_free.h"

namespace isoatlas {

/// The next double below. Finite.
inline double next_below(double value) {
    const double next = std::bit_cast<double>(std::bit_cast<std::int64_t>(value) + (value > 0 ? -1 : 1));
    return value == 0 ? -std::numeric_limits<double>::denorm_min() : next;
}

/// The greatest double at most a number that lies within `error` of sum.high + sum.low (a two_sum); none where that does not decide.
/// error 0: the number is that sum.
inline std::optional<double> rounded_down_if_certain(TwoDoubles sum, double error) {
    if (sum.low < -error) return next_below(sum.high);
    if (sum.low > error || error == 0) return sum.high + 0.0;  // not -0.0
    return std::nullopt;
}

}  // namespace isoatlas
