// Compressed streams in a part of a file, decompressed on reading in constant memory. Forward only; seeking backwards restarts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/common/byte_source.h"

namespace isoatlas {

class File;

/// A decompressor: of one stream, then of those that follow it.
class StreamDecoder {
public:
    enum class Result : std::uint8_t { more, end, damaged, no_memory };
    struct Step {
        Result result = Result::more;
        std::size_t read = 0, written = 0;  ///< bytes of `in` and of `out`
    };
    virtual ~StreamDecoder() = default;
    /// Begins with a stream whose first bytes these are. False: not enough memory.
    [[nodiscard]] virtual bool start(std::span<const std::byte> begin) = 0;
    /// Whether the bytes behind the end of a stream (at least 4, or all that are left) begin another one.
    [[nodiscard]] virtual bool follows(std::span<const std::byte> begin) const = 0;
    /// Decompresses some bytes; nothing read and nothing written: it needs more of the stream. out: 1 byte to 1 GiB.
    [[nodiscard]] virtual Step decode(std::span<const std::byte> in, std::span<std::byte> out) = 0;
    /// What is wrong with the stream after Result::damaged, "" where the library does not say it.
    [[nodiscard]] virtual std::string reason() const = 0;
    /// What it decompresses, with an article.
    [[nodiscard]] virtual const char* expected() const = 0;
    /// Bytes that one compressed byte stands for at best.
    [[nodiscard]] virtual std::int64_t max_ratio() const = 0;
};

class CompressedSource final : public ByteSource {
public:
    /// The bytes [offset, offset + length) of a file; length -1: up to its end. Throws Error{input} when the file cannot be opened or has
    /// no such range.
    CompressedSource(const std::string& path, std::int64_t offset, std::int64_t length, std::unique_ptr<StreamDecoder> decoder);
    ~CompressedSource() override;

    void read(std::span<std::byte> out) override;
    void seek(std::int64_t offset) override;
    [[nodiscard]] std::int64_t payload_bytes(std::int64_t max) override;
    [[nodiscard]] bool random_access() const override { return false; }
    [[nodiscard]] std::int64_t size_bound() const override;
    [[nodiscard]] const std::string& file() const override { return path_; }

    /// As read(), up to the end of the stream. Returns the number of bytes.
    std::size_t read_some(std::span<std::byte> out);
    /// The next bytes: max of them, or all when there are fewer.
    [[nodiscard]] std::vector<std::byte> read_some(std::int64_t max);
    /// Decodes to the end of the stream and its checksum, or to `max` + 1 bytes. Returns the number of bytes.
    [[nodiscard]] std::int64_t decoded_bytes(std::int64_t max);

private:
    void restart();
    bool refill();
    std::size_t decode_once(std::span<std::byte> out);
    bool another_stream();
    std::int64_t bytes_behind();
    [[nodiscard]] std::string here() const;
    [[noreturn]] void ends_early() const;
    [[noreturn]] void corrupt() const;
    [[noreturn]] void out_of_memory() const;

    std::string path_;
    std::unique_ptr<File> file_;
    std::unique_ptr<StreamDecoder> decoder_;
    std::int64_t begin_ = 0, end_ = 0;  // of the compressed bytes in the file
    std::int64_t next_read_ = 0;        // offset in the file after the buffer
    std::int64_t position_ = 0;         // in the decompressed stream
    bool finished_ = false;
    std::vector<std::byte> buffer_;
    std::span<const std::byte> unread_;  // of the buffer
};

}  // namespace isoatlas
