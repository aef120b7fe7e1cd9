// The frame of a store: every byte that no other checksum covers, which are HDF5's structures and the gaps around them. From version 3 on
// they lie under a checksum too, so no byte of the file can change unnoticed.
//
// It is written behind the end of what HDF5 knows: the ranges of the frame (two 64-bit numbers each: offset, bytes), their number, the
// checksum of the bytes in them one after the other, the checksum of all this, and 16 bytes that name it. docs/format.md shows it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isoatlas {

struct ByteRange {
    std::uint64_t offset, bytes;
    friend bool operator==(const ByteRange&, const ByteRange&) = default;
};

struct StoreFrame {
    std::vector<ByteRange> ranges;  ///< ascending, none empty, no two overlap or touch
    std::uint64_t checksum = 0;     ///< of their bytes
};

/// What of the bytes [0, size) lies in none of the ranges. They come in any order and may overlap.
[[nodiscard]] std::vector<ByteRange> outside(std::vector<ByteRange> ranges, std::uint64_t size);

/// Bytes at the end of a file that say how long the trailer is.
inline constexpr std::int64_t kTrailerEnd = 40;
[[nodiscard]] std::vector<std::byte> bytes_of_trailer(const StoreFrame& frame);
/// Bytes of the whole trailer, by the last kTrailerEnd bytes of a file; nothing: they are none of a trailer.
[[nodiscard]] std::optional<std::int64_t> trailer_bytes(std::span<const std::byte> end, std::int64_t file_size);
/// Of a whole trailer; nothing: it is damaged.
[[nodiscard]] std::optional<StoreFrame> frame_of_trailer(std::span<const std::byte> trailer, std::int64_t file_size);

}  // namespace isoatlas
