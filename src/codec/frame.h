// The frame of a store: all bytes that no other checksum covers, i.e. HDF5's structures and the gaps around them. From version 3 on they
// have a checksum too, so that a change of any byte is detected.
//
// It is written after the end of the HDF5 file: the ranges of the frame (two 64-bit numbers each: offset, bytes), their number, the
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

/// The bytes of [0, size) in none of the ranges, which may be unsorted and overlap.
[[nodiscard]] std::vector<ByteRange> outside(std::vector<ByteRange> ranges, std::uint64_t size);

/// Bytes at the end of a file that give the length of the trailer.
inline constexpr std::int64_t kTrailerEnd = 40;
[[nodiscard]] std::vector<std::byte> bytes_of_trailer(const StoreFrame& frame);
/// Bytes of the whole trailer, by the last kTrailerEnd bytes of a file; nullopt: not a trailer.
[[nodiscard]] std::optional<std::int64_t> trailer_bytes(std::span<const std::byte> end, std::int64_t file_size);
/// Parses a whole trailer; nullopt: it is damaged.
[[nodiscard]] std::optional<StoreFrame> frame_of_trailer(std::span<const std::byte> trailer, std::int64_t file_size);

}  // namespace isoatlas
