// Lossless compression of a brick of samples: finite differences of integers, packed in groups of minimal bit width; or the samples as they
// are.
//
//   1 byte    orders of the differences along x, y, z (differences.h), two bits each; plus 64 or 128 for floats in units
//   2 bytes   floats in units only: exponent of the unit (float_units.h), as int16
//   groups    (bit_groups.h) the differences, arranged (differences.h), padded with zeros to a multiple of 8
//   tails     floats in units with 128 in the first byte only (float_units.h)
//
// or 192, then the samples as they are, where the above saves less than an eighth of them, of floats less than a quarter.
//
// The numbers are relative to that of the lowest sample, which is stored elsewhere: order-preserving keys
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

/// The code of a brick.
struct BrickCode {
    std::uint8_t head = 0;  ///< its first byte
    std::int64_t bytes = 0;
};

/// Chooses a code for the samples of a box, x fastest, at most kBrickSamples, not constant. Cost: about seven encodings.
template <class T>
[[nodiscard]] BrickCode choose_code(std::span<const T> samples, const Index3& size, T low);

/// The code with the first byte that a store has, whatever that saves; a chosen one, where it does not fit the samples. Cost: an encoding.
template <class T>
[[nodiscard]] BrickCode code_as(std::span<const T> samples, const Index3& size, T low, std::uint8_t head);

/// Appends the samples, encoded with their chosen code; low is the lowest of them.
template <class T>
void encode_brick(std::span<const T> samples, const Index3& size, T low, std::uint8_t head, std::vector<std::byte>& out);

/// Inverse. Returns whether `packed` is exactly a brick of that size; any bytes are safe. An empty packed brick has samples that are all
/// low.
template <class T>
[[nodiscard]] bool decode_brick(std::span<const std::byte> packed, const Index3& size, T low, std::span<T> samples);

}  // namespace isoatlas
