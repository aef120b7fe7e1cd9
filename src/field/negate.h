// Negates samples in place (isoatlas/polarity.h).
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>

#include "isoatlas/polarity.h"

namespace isoatlas {

/// An involution without overflow: -s of floats, lowest + highest - s of integers.
template <class T>
[[nodiscard]] constexpr T negated_sample(T sample) {
    if constexpr (std::is_floating_point_v<T>) {
        return -sample;
    } else {
        return static_cast<T>(~sample);  // of n bits: 2^n - 1 - s, or -1 - s
    }
}

/// bytes: samples of a type, perhaps more than memory holds. Cost: a pass over them.
void negate_samples(ValueType type, std::span<std::byte> bytes);

}  // namespace isoatlas
