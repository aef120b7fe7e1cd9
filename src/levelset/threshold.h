// tau in the type of the samples, so that a row is compared without converting it.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

namespace isoatlas {

/// value >= tau for a sample of T is `!none_high && value >= min`.
template <class T>
struct Threshold {
    T min;           ///< smallest T that is >= tau
    bool none_high;  ///< no T is >= tau
};

template <class T>
Threshold<T> threshold_for(double tau) {
    using Limits = std::numeric_limits<T>;
    if (tau > static_cast<double>(Limits::max())) return {Limits::max(), true};
    if (tau <= static_cast<double>(Limits::lowest())) return {Limits::lowest(), false};
    if constexpr (std::is_integral_v<T>) {
        return {static_cast<T>(std::ceil(tau)), false};
    } else {
        T min = static_cast<T>(tau);
        if (static_cast<double>(min) < tau) min = std::nextafter(min, Limits::max());
        return {min, false};
    }
}

}  // namespace isoatlas
