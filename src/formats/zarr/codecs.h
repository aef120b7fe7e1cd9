// The codecs that turn the bytes of a chunk into other bytes: compressors, checksums and filters of Zarr.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace isoatlas {

/// A number in a filter: an integer of 1 to 8 bytes or a floating-point one of 4 or 8.
struct CodecNumber {
    char kind = 'i';  ///< 'i' signed, 'u' unsigned, 'f'
    std::size_t bytes = 1;
    bool big_endian = false;
    bool operator==(const CodecNumber&) const = default;
};

struct ByteCodec {
    enum class Kind : std::uint8_t { inflate, bzip2, zstd, lz4, blosc, crc32c, shuffle, delta, scale } kind = Kind::inflate;
    std::size_t element = 1;           ///< shuffle: bytes
    CodecNumber decoded{}, encoded{};  ///< delta, scale
    double scale = 1, offset = 0;      ///< scale: decoded = encoded / scale + offset
};

/// Bytes that `decoded` bytes have at most behind the codec.
[[nodiscard]] std::size_t most_encoded(const ByteCodec& codec, std::size_t decoded);

/// Undoes one codec. Takes memory for at most `most` bytes, and for no more than the encoded bytes can stand for. Returns a description of
/// what is wrong with the bytes, "" for nothing; also when they stand for more than `most`.
[[nodiscard]] std::string decode(const ByteCodec& codec, std::span<const std::byte> encoded, std::size_t most, std::vector<std::byte>& out);

/// Undoes codecs, given in the order of encoding; `value` holds the encoded bytes, then the decoded ones: exactly `bytes` of them.
/// scratch: memory to use again. Returns a description of the error, "" for none.
[[nodiscard]] std::string decode_all(std::span<const ByteCodec> codecs, std::size_t bytes, std::vector<std::byte>& value,
                                     std::vector<std::byte>& scratch);

/// A deflate stream without header, of exactly `bytes` bytes. Returns a description of the error, "" for none.
[[nodiscard]] std::string inflate_raw(std::span<const std::byte> encoded, std::size_t bytes, std::vector<std::byte>& out);

/// A buffer of blosc (zstd, level 5, bytes of elements shuffled): the same for the same bytes, always. At most 2^31 - 17 bytes.
[[nodiscard]] std::vector<std::byte> encode_blosc(std::span<const std::byte> bytes, std::size_t element);

/// The checksum of RFC 3720 (Castagnoli).
[[nodiscard]] std::uint32_t crc32c(std::span<const std::byte> bytes);

}  // namespace isoatlas
