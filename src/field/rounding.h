// Rounding of saddle values to double: once, downwards.
//
// The value of an element is the greatest double at most the exact one. So "value >= tau" is true exactly when "exact value >= tau" is, for
// every isovalue tau there is (docs/theory/1-elements-and-order.md#numbers). Rounding to nearest could lift a saddle to a sample above it.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "base/error_free.h"

namespace isoatlas {

/// The next double below. Finite.
inline double next_below(double value) {
    const double next = std::bit_cast<double>(std::bit_cast<std::int64_t>(value) + (value > 0 ? -1 : 1));
    return value == 0 ? -std::numeric_limits<double>::denorm_min() : next;
}

inline constexpr double kUndecided = std::numeric_limits<double>::quiet_NaN();

/// The greatest double at most a number that lies within `error` of sum.high + sum.low (a two_sum); kUndecided where that does not decide.
/// error 0: the number is that sum. No branches: loops over it become vector code.
inline double rounded_down_or_undecided(TwoDoubles sum, double error) {
    const double down = next_below(sum.high), same = sum.high + 0.0;  // not -0.0
    return sum.low < -error ? down : ((sum.low > error) | (error == 0)) ? same : kUndecided;
}

}  // namespace isoatlas
