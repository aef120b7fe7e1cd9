// Chunks of arrays, compressed as HDF5's filters "shuffle" and "deflate" would: any HDF5 reader opens them.
//
// Shuffle puts the first bytes of all numbers in front, then the second bytes, ...: ids and sorted values have high bytes that hardly
// change.
//
// In the literature: byte shuffle and DEFLATE (Deutsch, RFC 1951, 1996).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isoatlas {

inline constexpr std::int64_t kChunk = std::int64_t{1} << 16;  ///< numbers in a chunk
inline constexpr int kDeflateLevel = 6;

/// width: bytes of a number; raw.size() is a multiple of it. Cost: about 150 million bytes a second.
[[nodiscard]] std::vector<std::byte> encode_chunk(std::span<const std::byte> raw, std::int64_t width);

/// Fills raw. Returns false when the bytes are not the code of exactly that many.
[[nodiscard]] bool decode_chunk(std::span<const std::byte> packed, std::int64_t width, std::span<std::byte> raw);

}  // namespace isoatlas
