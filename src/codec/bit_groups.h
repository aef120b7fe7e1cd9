// Packs numbers in groups of 8, each group with the bit width of its largest number.
//
//   1 byte    width of the narrowest group, in bits
//   1 byte    m: bits of the excess of a group's width over that
//   widths    these excesses, 8 at a time, as groups of m bits
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

/// Size of the output of pack_groups in bytes. N: an unsigned type; numbers.size() % kGroup == 0 here and below; at most 2^16 numbers.
template <class N>
[[nodiscard]] std::int64_t group_bytes(std::span<const N> numbers);

template <class N>
void pack_groups(std::span<const N> numbers, std::vector<std::byte>& out);

/// Inverse; advances `packed` past the groups. Returns whether the groups are valid; any bytes are safe.
template <class N>
[[nodiscard]] bool unpack_groups(std::span<const std::byte>& packed, std::span<N> numbers);

}  // namespace isoatlas
