// Numbers in groups of 8, each group in as many bits as its largest number needs.
//
//   1 byte    width of the narrowest group, in bits
//   1 byte    m: bits of what the width of a group is more than that
//   widths    these differences, 8 at a time, as groups of m bits
//   groups    of width w: the lowest bytes of the 8 numbers, then the next ones (w / 8 of them), then one byte for each bit that is left,
//             number i in bit i
//
// In the literature: binary packing, frame of reference (Lemire, Boytsov, Decoding billions of integers per second through vectorization,
// 2015).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isoatlas {

inline constexpr std::size_t kGroup = 8;

/// Bytes that pack_groups would append. N: an unsigned type; numbers.size() % kGroup == 0 here and below; at most 2^16 numbers.
template <class N>
[[nodiscard]] std::int64_t group_bytes(std::span<const N> numbers);

template <class N>
void pack_groups(std::span<const N> numbers, std::vector<std::byte>& out);

/// Inverse; moves `packed` behind what it has read. Returns whether there were such groups; any bytes are safe.
template <class N>
[[nodiscard]] bool unpack_groups(std::span<const std::byte>& packed, std::span<N> numbers);

}  // namespace isoatlas
