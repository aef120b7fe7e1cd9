// Compression of array chunks, compatible with HDF5's filters "shuffle" and "deflate".
//
// Shuffle stores the first bytes of all numbers first, then the second bytes, ...: the high bytes of ids and sorted values hardly change.
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

/// Fills raw. Returns false unless the input decodes to exactly that many bytes.
[[nodiscard]] bool decode_chunk(std::span<const std::byte> packed, std::int64_t width, std::span<std::byte> raw);

}  // namespace isoatlas
