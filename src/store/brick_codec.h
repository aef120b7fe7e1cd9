// One brick of samples as a row of bits: every sample minus the lowest one, in as many bits as the highest needs (frame of reference).
//
// Floats are mapped to integers of the same order first (field/order.h). Decoding gives the same bits. Constant bricks take no room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace isoatlas::store {

/// The lowest and the highest of some samples, -0.0 below 0.0. T: a sample type.
template <class T>
[[nodiscard]] std::pair<T, T> extremes_of(std::span<const T> samples);

/// Bits of a sample of a brick with these extremes.
template <class T>
[[nodiscard]] int bits_of_range(T low, T high);

/// Bytes of `count` samples of so many bits.
[[nodiscard]] constexpr std::int64_t packed_bytes(std::int64_t count, int bits) { return (count * bits + 7) / 8; }

/// Appends the samples; low is the lowest of them.
template <class T>
void encode_brick(std::span<const T> samples, T low, int bits, std::vector<std::byte>& out);

/// Inverse. packed.size() == packed_bytes(samples.size(), bits); bits <= 8 * sizeof(T). Any bytes give some samples.
template <class T>
void decode_brick(std::span<const std::byte> packed, T low, int bits, std::span<T> samples);

}  // namespace isoatlas::store
