// One brick of samples in few bytes: differences of whole numbers, in groups of as many bits as they need. Nothing is lost.
//
//   1 byte    orders of the differences along x, y, z (differences.h), two bits each; 64 or 128 more for floats in units
//   2 bytes   floats in units only: exponent of the unit (float_units.h), as int16
//   groups    (bit_groups.h) the differences, arranged (differences.h), zeros behind them to a multiple of 8
//   tails     floats in units with 128 in the first byte only (float_units.h)
//
// The numbers are those of the samples above that of the lowest one, which must be known from elsewhere: keys of the same order
// (sample_keys.h), or floats in units. A constant brick has no bytes.
//
// In the literature: lossless predictive coding (Lindstrom, Isenburg, Fast and efficient compression of floating-point data, 2006).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "codec/differences.h"
#include "field/brick_grid.h"

namespace isoatlas {

/// The lowest and the highest of some samples, -0.0 below 0.0. T: a sample type, here and below.
template <class T>
[[nodiscard]] std::pair<T, T> extremes_of(std::span<const T> samples);

/// How a brick is coded.
struct BrickCode {
    std::uint8_t head = 0;  ///< its first byte
    std::int64_t bytes = 0;
};

/// A small code for samples of a box, x fastest, at most kBrickSamples, not constant. Cost: about seven codings.
template <class T>
[[nodiscard]] BrickCode choose_code(std::span<const T> samples, const BoxSize& size, T low);

/// Appends the samples with a code that was chosen for them; low is the lowest of them.
template <class T>
void encode_brick(std::span<const T> samples, const BoxSize& size, T low, std::uint8_t head, std::vector<std::byte>& out);

/// Inverse. Returns whether `packed` is a brick of that size and nothing more; any bytes are safe. Samples of a packed brick of no bytes
/// are all low.
template <class T>
[[nodiscard]] bool decode_brick(std::span<const std::byte> packed, const BoxSize& size, T low, std::span<T> samples);

}  // namespace isoatlas
