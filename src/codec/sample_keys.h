// Order-preserving integer keys of samples, for lossless differences.
// In the literature: order-preserving map of floats to integers (Lindstrom, Isenburg, Fast and efficient compression of floating-point
// data, 2006).
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

namespace isoatlas {

/// The unsigned type as wide as T.
template <class T>
using Key =
    std::conditional_t<sizeof(T) == 1, std::uint8_t,
                       std::conditional_t<sizeof(T) == 2, std::uint16_t, std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

/// Every bit counts, so -0.0 lies below 0.0. Of floats: all bits flipped for negative numbers, else the sign bit.
template <class T>
[[nodiscard]] Key<T> key_of(T sample) {
    constexpr Key<T> kSign = static_cast<Key<T>>(Key<T>{1} << (8 * sizeof(T) - 1));
    const Key<T> bits = std::bit_cast<Key<T>>(sample);
    if constexpr (std::is_unsigned_v<T>) return bits;
    if constexpr (std::is_integral_v<T>) return static_cast<Key<T>>(bits ^ kSign);
    return bits & kSign ? static_cast<Key<T>>(~bits) : static_cast<Key<T>>(bits | kSign);
}

template <class T>
[[nodiscard]] T sample_of(Key<T> key) {
    constexpr Key<T> kSign = static_cast<Key<T>>(Key<T>{1} << (8 * sizeof(T) - 1));
    if constexpr (std::is_unsigned_v<T>) return key;
    if constexpr (std::is_integral_v<T>) return std::bit_cast<T>(static_cast<Key<T>>(key ^ kSign));
    return std::bit_cast<T>(key & kSign ? static_cast<Key<T>>(key & ~kSign) : static_cast<Key<T>>(~key));
}

}  // namespace isoatlas
