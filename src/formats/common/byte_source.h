// ByteSource: the payload of a file as one stream of bytes, independent of its encoding. Position 0 is the first payload byte.
//
// Readers seek and read; an uncompressed file seeks in O(1), a compressed one restarts to seek backwards. Memory is bounded by a fixed
// buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace isoatlas {

class File;

class ByteSource {
public:
    virtual ~ByteSource() = default;
    /// Fills all of out from the current position and advances.
    /// Throws Error{input} with file, offset and expected bytes when the stream ends early, is corrupt or cannot be read.
    virtual void read(std::span<std::byte> out) = 0;
    /// Moves to a payload position (0: start). Cost: O(1) with random_access(), else O(distance), or O(offset) to seek backwards.
    virtual void seek(std::int64_t offset) = 0;
    /// Bytes of the payload, including those that follow a compressed stream in its file (unless all are zero: padding); `max` + 1 stands
    /// for more than `max`.
    /// Without random_access() it is read to its end from the current position, with a fixed buffer: Error{input} when a checksum is
    /// wrong or the end is missing. Seek before the next read.
    [[nodiscard]] virtual std::int64_t payload_bytes(std::int64_t max) = 0;
    [[nodiscard]] virtual bool random_access() const = 0;
    /// The size of the payload with random_access(), else an upper bound of it that follows from the size of the file.
    [[nodiscard]] virtual std::int64_t size_bound() const = 0;
    /// The file name for messages.
    [[nodiscard]] virtual const std::string& file() const = 0;
};

/// The bytes [offset, offset + length) of a file; length -1: up to its end.
/// Throws Error{input} when the file cannot be opened or has no such range.
[[nodiscard]] std::unique_ptr<ByteSource> open_file_source(const std::string& path, std::int64_t offset = 0, std::int64_t length = -1);
/// The same of an open file; path: for messages.
[[nodiscard]] std::unique_ptr<ByteSource> open_file_source(std::unique_ptr<File> file, const std::string& path, std::int64_t offset = 0,
                                                           std::int64_t length = -1);

/// The bytes of a source from `offset` on: position 0 is that byte. Seek before the first read.
[[nodiscard]] std::unique_ptr<ByteSource> skip_bytes(std::unique_ptr<ByteSource> source, std::int64_t offset);

/// The decompressed bytes of a gzip (also of several members) or zlib stream in [offset, offset + length) of a file.
/// size_bound() is 1032 times the compressed size: deflate cannot do better (a 2-bit pair stands for at most 258 bytes).
[[nodiscard]] std::unique_ptr<ByteSource> open_inflate_source(const std::string& path, std::int64_t offset = 0, std::int64_t length = -1);

/// Decompressed bytes of the zlib stream at [offset, offset + length) of a file: decoded to its end, with its checksum; bytes after it are
/// ignored. `max` + 1 stands for more than `max`. Throws Error{input} as reading does.
[[nodiscard]] std::int64_t inflated_bytes(const std::string& path, std::int64_t offset, std::int64_t length, std::int64_t max);

/// Reads a source to its end after the `wanted` bytes of samples. Throws Error{input} when it is damaged, shorter, or longer and
/// `skip_rest` is false; also when it is longer by more than kMaxRest. Returns the number of additional bytes.
std::int64_t require_end(ByteSource& source, std::int64_t wanted, bool skip_rest);
/// The error of require_end() for that many bytes after the samples of a file.
[[noreturn]] void refuse_rest(const std::string& file, std::int64_t rest);
/// Max bytes after the samples of a compressed stream, or 16 times the samples; more is not decompressed.
inline constexpr std::int64_t kMaxRest = std::int64_t{1} << 30;

/// `count` sources of part_bytes payload bytes each, one after the other; open(i) is called when part i is needed, one is open at a time
/// and read to its end as require_end() does. The caller guarantees random access and the bound (it has checked the files).
struct PartsPlan {
    std::int64_t count = 0;
    std::int64_t part_bytes = 0;  ///< positive
    std::int64_t size_bound = 0;
    bool random_access = false;
    bool skip_rest = false;  ///< bytes after part_bytes in a part are not an error
    std::function<std::unique_ptr<ByteSource>(std::int64_t part)> open{};
    std::string file{};  ///< the file that lists the parts, for messages
};
[[nodiscard]] std::unique_ptr<ByteSource> open_parts_source(PartsPlan plan);

/// Size of a regular file in bytes. Throws Error{input} like opening it.
[[nodiscard]] std::int64_t file_size(const std::string& path);
/// The first bytes of a file: max of them, or all when it is smaller.
[[nodiscard]] std::vector<std::byte> read_header_bytes(const std::string& path, std::int64_t max);
/// The first bytes of the payload of a gzip or zlib file: at most max. Throws Error{input} on a corrupt stream.
[[nodiscard]] std::vector<std::byte> read_inflated_bytes(const std::string& path, std::int64_t max);
/// Whether the bytes start with the magic number of gzip.
[[nodiscard]] bool starts_like_gzip(std::span<const std::byte> bytes);

}  // namespace isoatlas
