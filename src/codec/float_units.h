// Floats as integers in one unit, a power of 2: their differences are small where the samples are smooth, also across changes of exponent
// or sign.
//
// The unit is the last place of the largest sample, or a larger one if all samples are multiples of it. Bits of smaller samples below the
// unit are their tail and are stored verbatim.
//
// In the literature: block floating point (Lindstrom, Fixed-rate compressed floating-point arrays, 2014), here without loss.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "codec/sample_keys.h"

namespace isoatlas {

struct Units {
    int exponent = 0;    ///< the unit is 2^exponent
    bool exact = false;  ///< no sample has a tail
};

/// nullopt if a sample is not finite. T: float, double; here and below.
template <class T>
[[nodiscard]] std::optional<Units> units_of(std::span<const T> samples);

/// A sample in units of its last place or more, rounded towards zero; negative numbers in two's complement. Unspecified for smaller units.
template <class T>
[[nodiscard]] Key<T> in_units(T sample, const Units& units);

/// Samples without tails.
template <class T>
void from_units(std::span<const Key<T>> numbers, const Units& units, std::span<T> samples);

/// Bits of the tails of all samples. For a sample of 0 units: one bit, which is 1 if it is not +0.0; then all its bits follow. Else its
/// bits below the unit.
template <class T>
[[nodiscard]] std::int64_t tail_bits(std::span<const T> samples, const Units& units);

/// Appends the tails one after the other, the lowest bit first.
template <class T>
void append_tails(std::span<const T> samples, const Units& units, std::vector<std::byte>& out);

/// Samples from their numbers and tails. Returns whether `tails` has the required size; any bytes are safe.
template <class T>
[[nodiscard]] bool join_tails(std::span<const Key<T>> numbers, std::span<const std::byte> tails, const Units& units, std::span<T> samples);

}  // namespace isoatlas
