#include "formats/zarr/codecs.h"

#include <blosc.h>
#include <bzlib.h>
#include <lz4.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <limits>

#include "base/check.h"
#include "formats/common/field_reader.h"
#include "formats/zarr/filters.h"

namespace isoatlas {
namespace {

constexpr std::size_t kInts = static_cast<std::size_t>(std::numeric_limits<int>::max());

std::string too_long(std::size_t most) { return "it stands for more than " + std::to_string(most) + " bytes"; }

/// What `encoded` bytes can stand for at best, at most `most`.
std::size_t room_of(std::size_t encoded, std::size_t ratio, std::size_t most) {
    return encoded > most / ratio ? most : std::min(most, encoded * ratio + ratio);
}

/// All members of a gzip file, or one zlib stream; window: of zlib.
std::string inflate_bytes(std::span<const std::byte> encoded, int window, std::size_t most, std::vector<std::byte>& out) {
    constexpr std::size_t kRatio = 1032;
    out.resize(room_of(encoded.size(), kRatio, most));
    z_stream stream{};
    if (::inflateInit2(&stream, window) != Z_OK) return "zlib cannot start";
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(encoded.data()));
    std::size_t read = 0, written = 0;
    std::string error;
    for (int result = Z_OK; error.empty();) {
        const std::size_t in = std::min(encoded.size() - read, kInts), room = std::min(out.size() - written, kInts);
        std::byte none{};  // zlib takes no null pointer
        stream.avail_in = static_cast<uInt>(in), stream.avail_out = static_cast<uInt>(std::max<std::size_t>(room, 1));
        stream.next_out = reinterpret_cast<Bytef*>(room > 0 ? out.data() + written : &none);
        result = ::inflate(&stream, Z_NO_FLUSH);
        const std::size_t got = std::max<std::size_t>(room, 1) - stream.avail_out;
        read += in - stream.avail_in;
        if (got > room) {
            error = too_long(out.size());
            break;
        }
        written += got;
        if (result == Z_STREAM_END) {
            if (read == encoded.size()) break;
            if (window < 0 || ::inflateReset(&stream) != Z_OK) error = "bytes follow the compressed stream";
        } else if (result != Z_OK || (got == 0 && in == stream.avail_in)) {
            error =
                read == encoded.size() && result != Z_DATA_ERROR ? "the compressed stream ends early" : "the compressed stream is damaged";
        }
    }
    ::inflateEnd(&stream);
    out.resize(written);
    return error;
}

/// One stream of bzip2.
std::string decode_bzip2(std::span<const std::byte> encoded, std::size_t most, std::vector<std::byte>& out) {
    constexpr std::size_t kRatio = std::size_t{1} << 21;  // a block of 40 bytes stands for at most 46 MB
    out.resize(room_of(encoded.size(), kRatio, most));
    if (encoded.size() > kInts) return "the stream of bzip2 is too long";
    bz_stream stream{};
    if (::BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return "bzip2 cannot start";
    stream.next_in = reinterpret_cast<char*>(const_cast<std::byte*>(encoded.data()));
    stream.avail_in = static_cast<unsigned>(encoded.size());
    std::size_t written = 0;
    std::string error;
    for (int result = BZ_OK; result == BZ_OK && error.empty();) {
        const std::size_t room = std::min(out.size() - written, kInts);
        char none = 0;  // room for the end alone
        stream.avail_out = static_cast<unsigned>(std::max<std::size_t>(room, 1));
        stream.next_out = room > 0 ? reinterpret_cast<char*>(out.data() + written) : &none;
        const unsigned before = stream.avail_in;
        result = ::BZ2_bzDecompress(&stream);
        const std::size_t got = std::max<std::size_t>(room, 1) - stream.avail_out;
        if (got > room) {
            error = too_long(out.size());
        } else if (result == BZ_OK && got == 0 && before == stream.avail_in) {
            error = "the compressed stream ends early";
        } else if (result != BZ_OK && result != BZ_STREAM_END) {
            error = "the compressed stream is damaged";
        } else if (result == BZ_STREAM_END && stream.avail_in > 0) {
            error = "bytes follow the compressed stream";
        }
        written += std::min(got, room);
    }
    ::BZ2_bzDecompressEnd(&stream);
    out.resize(written);
    return error;
}

std::string decode_zstd(std::span<const std::byte> encoded, std::size_t most, std::vector<std::byte>& out) {
    constexpr std::size_t kRatio = 1 << 16;  // a block of 4 bytes stands for at most 128 KiB
    out.resize(room_of(encoded.size(), kRatio, most));
    const std::size_t got = ::ZSTD_decompress(out.data(), out.size(), encoded.data(), encoded.size());
    if (::ZSTD_isError(got) != 0U) return std::string("zstd: ") + ::ZSTD_getErrorName(got);
    out.resize(got);
    return "";
}

/// As numcodecs writes it: the size in 4 bytes, then one block.
std::string decode_lz4(std::span<const std::byte> encoded, std::size_t most, std::vector<std::byte>& out) {
    constexpr std::size_t kHeader = 4, kRatio = 255;
    if (encoded.size() < kHeader || encoded.size() > kInts) return "the block of lz4 ends early";
    const std::size_t bytes = FieldReader(encoded, false).at<std::uint32_t>(0);
    if (bytes > room_of(encoded.size(), kRatio, most) || bytes > kInts) return too_long(std::min(most, kRatio * encoded.size()));
    out.resize(bytes);
    const int got = ::LZ4_decompress_safe(reinterpret_cast<const char*>(encoded.data()) + kHeader, reinterpret_cast<char*>(out.data()),
                                          static_cast<int>(encoded.size() - kHeader), static_cast<int>(bytes));
    return got == static_cast<int>(bytes) ? "" : "the block of lz4 is damaged";
}

std::string decode_blosc(std::span<const std::byte> encoded, std::size_t most, std::vector<std::byte>& out) {
    constexpr std::size_t kRatio = 1 << 16;
    std::size_t bytes = 0;
    if (encoded.size() < BLOSC_MIN_HEADER_LENGTH || ::blosc_cbuffer_validate(encoded.data(), encoded.size(), &bytes) < 0)
        return "the header of blosc is damaged, or the buffer is cut off";
    if (bytes > room_of(encoded.size(), kRatio, most)) return too_long(std::min(most, kRatio * encoded.size()));
    out.resize(bytes);
    const int got = bytes == 0 ? 0 : ::blosc_decompress_ctx(encoded.data(), out.data(), bytes, 1);
    return got == static_cast<int>(bytes) ? "" : "the buffer of blosc is damaged, or its compressor is not built in";
}

std::string decode_checksum(std::span<const std::byte> encoded, std::size_t most, std::vector<std::byte>& out) {
    constexpr std::size_t kChecksum = 4;
    if (encoded.size() < kChecksum) return "the checksum is missing";
    const std::span<const std::byte> bytes = encoded.first(encoded.size() - kChecksum);
    if (bytes.size() > most) return too_long(most);
    if (crc32c(bytes) != FieldReader(encoded, false).at<std::uint32_t>(bytes.size())) return "the checksum (crc32c) is wrong";
    out.assign(bytes.begin(), bytes.end());
    return "";
}

constexpr std::array<std::uint32_t, 256> crc_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t rest = byte;
        for (int bit = 0; bit < 8; ++bit) rest = (rest & 1U) != 0 ? rest >> 1 ^ 0x82f63b78U : rest >> 1;
        table[byte] = rest;
    }
    return table;
}

}  // namespace

std::uint32_t crc32c(std::span<const std::byte> bytes) {
    static constexpr std::array<std::uint32_t, 256> kTable = crc_table();
    std::uint32_t sum = 0xffffffffU;
    for (const std::byte byte : bytes) sum = sum >> 8 ^ kTable[(sum ^ std::to_integer<std::uint32_t>(byte)) & 0xffU];
    return ~sum;
}

std::vector<std::byte> encode_blosc(std::span<const std::byte> bytes, std::size_t element) {
    constexpr int kLevel = 5, kAnyBlock = 0, kThreads = 1;
    std::vector<std::byte> encoded(bytes.size() + BLOSC_MAX_OVERHEAD);
    const int size = ::blosc_compress_ctx(kLevel, BLOSC_SHUFFLE, element, bytes.size(), bytes.data(), encoded.data(), encoded.size(),
                                          "zstd", kAnyBlock, kThreads);
    ISOATLAS_CHECK(size > 0);
    encoded.resize(static_cast<std::size_t>(size));
    return encoded;
}

std::string inflate_raw(std::span<const std::byte> encoded, std::size_t bytes, std::vector<std::byte>& out) {
    std::string error = inflate_bytes(encoded, -15, bytes, out);
    if (error.empty() && out.size() != bytes) error = "it stands for " + std::to_string(out.size()) + " bytes";
    return error;
}

std::size_t most_encoded(const ByteCodec& codec, std::size_t decoded) {
    constexpr std::size_t kOverhead = 1 << 16;
    switch (codec.kind) {
        case ByteCodec::Kind::shuffle: return decoded;
        case ByteCodec::Kind::crc32c: return decoded + 4;
        case ByteCodec::Kind::delta:
        case ByteCodec::Kind::scale: return decoded / codec.decoded.bytes * codec.encoded.bytes;
        default: return decoded + decoded / 8 + kOverhead;
    }
}

std::string decode(const ByteCodec& codec, std::span<const std::byte> encoded, std::size_t most, std::vector<std::byte>& out) {
    constexpr int kAnyWrapper = 15 + 32;
    switch (codec.kind) {
        case ByteCodec::Kind::inflate: return inflate_bytes(encoded, kAnyWrapper, most, out);
        case ByteCodec::Kind::bzip2: return decode_bzip2(encoded, most, out);
        case ByteCodec::Kind::zstd: return decode_zstd(encoded, most, out);
        case ByteCodec::Kind::lz4: return decode_lz4(encoded, most, out);
        case ByteCodec::Kind::blosc: return decode_blosc(encoded, most, out);
        case ByteCodec::Kind::crc32c: return decode_checksum(encoded, most, out);
        case ByteCodec::Kind::shuffle:
        case ByteCodec::Kind::delta:
        case ByteCodec::Kind::scale: break;
    }
    return undo_filter(codec, encoded, most, out);
}

std::string decode_all(std::span<const ByteCodec> codecs, std::size_t bytes, std::vector<std::byte>& value,
                       std::vector<std::byte>& scratch) {
    std::vector<std::size_t> most{bytes};  // before each codec
    for (const ByteCodec& codec : codecs) most.push_back(most_encoded(codec, most.back()));
    for (std::size_t i = codecs.size(); i-- > 0;) {
        if (std::string error = decode(codecs[i], value, most[i], scratch); !error.empty()) return error;
        std::swap(value, scratch);
    }
    if (value.size() == bytes) return "";
    return "it holds " + std::to_string(value.size()) + " bytes instead of " + std::to_string(bytes);
}

}  // namespace isoatlas
