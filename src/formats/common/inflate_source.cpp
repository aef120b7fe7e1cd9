// Inflates gzip and zlib streams with zlib. Forward only; seeking backwards restarts.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

#include "formats/common/byte_source.h"
#include "formats/common/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaximalRatio = 1032;  // zlib's documentation: the limit of the deflate format
constexpr std::int64_t kStreamBytes = 256 * 1024;
constexpr std::size_t kMaxPerCall = 1U << 30;  // zlib counts in 32 bits
constexpr int kDetectGzipOrZlib = 15 + 32;     // windowBits: largest window, the stream's header decides

/// RAII for zlib's stream, also when the constructor of its owner throws after inflateInit2.
struct Inflater : z_stream {
    Inflater() : z_stream{} {}
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() { inflateEnd(this); }
};

class InflateSource final : public ByteSource {
public:
    InflateSource(const std::string& path, std::int64_t offset, std::int64_t length) : path_(path), file_(open_file(path)) {
        const std::int64_t file_bytes = file_->size();
        if (offset < 0 || offset >= file_bytes || length > file_bytes - offset) {
            throw Error(ErrorKind::input,
                        {.file = path,
                         .where = "offset " + std::to_string(offset),
                         .what = "the file ends before its compressed samples do: it has " + std::to_string(file_bytes) + " bytes",
                         .expected = length < 0 ? "a gzip or zlib stream" : std::to_string(length) + " compressed bytes",
                         .next = "the file is truncated or its header is wrong: get it again"});
        }
        begin_ = offset;
        end_ = length < 0 ? file_bytes : offset + length;
        buffer_.resize(static_cast<std::size_t>(std::min(kStreamBytes, end_ - begin_)));
        if (inflateInit2(&stream_, kDetectGzipOrZlib) != Z_OK) out_of_memory();
        restart();
    }

    void read(std::span<std::byte> out) override {
        const std::size_t got = read_some(out);
        if (got == out.size()) return;
        throw Error(ErrorKind::input, {.file = path_,
                                       .where = "byte " + std::to_string(position_) + " of the decompressed data",
                                       .what = "the compressed data end early",
                                       .expected = std::to_string(out.size() - got) + " more bytes",
                                       .next = "the file is truncated or its header claims too much: get it again"});
    }
    void seek(std::int64_t offset) override {
        if (offset < position_) restart();
        std::array<std::byte, 16384> scratch;
        while (position_ < offset) {
            read(std::span(scratch).first(static_cast<std::size_t>(std::min<std::int64_t>(scratch.size(), offset - position_))));
        }
    }
    std::int64_t payload_bytes(std::int64_t max) override {
        const std::int64_t inside = decoded_bytes(max), behind = finished_ ? bytes_behind() : 0;
        return inside > max || behind > max - inside ? max + 1 : inside + behind;
    }
    bool random_access() const override { return false; }
    std::int64_t size_bound() const override {
        const std::int64_t limit = std::numeric_limits<std::int64_t>::max() / kMaximalRatio;
        return std::min(end_ - begin_, limit) * kMaximalRatio;
    }
    const std::string& file() const override { return path_; }

    std::size_t read_some(std::span<std::byte> out) {
        std::size_t done = 0;
        while (done < out.size() && !finished_) done += inflate_once(out.subspan(done));
        position_ += static_cast<std::int64_t>(done);
        return done;
    }

    /// Decodes to the end of the stream and its checksum, or to `max` + 1 bytes. Returns the number of bytes.
    std::int64_t decoded_bytes(std::int64_t max) {
        std::array<std::byte, 65536> scratch;
        while (!finished_ && position_ <= max) {
            const auto room = std::min(static_cast<std::int64_t>(scratch.size()), max - position_ + 1);
            (void)read_some(std::span(scratch).first(static_cast<std::size_t>(room)));
        }
        return position_;
    }

private:
    void restart() {
        inflateReset2(&stream_, kDetectGzipOrZlib);
        stream_.avail_in = 0;
        next_read_ = begin_;
        position_ = 0;
        finished_ = false;
        refill();
        gzip_ = starts_like_gzip(std::span(buffer_).first(stream_.avail_in));
    }

    /// Keeps the unread bytes of the buffer and appends bytes of the file; false at the end of the file.
    bool refill() {
        if (next_read_ == end_) return false;
        const std::size_t kept = stream_.avail_in;
        std::copy_n(reinterpret_cast<const std::byte*>(stream_.next_in), kept, buffer_.data());
        const auto room = static_cast<std::int64_t>(buffer_.size() - kept);
        const auto bytes = static_cast<std::size_t>(std::min(room, end_ - next_read_));
        read_fully(*file_, path_, next_read_, std::span(buffer_).subspan(kept, bytes));
        next_read_ += static_cast<std::int64_t>(bytes);
        stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
        stream_.avail_in = static_cast<uInt>(kept + bytes);
        return true;
    }

    /// One call of zlib; the number of bytes it produced.
    std::size_t inflate_once(std::span<std::byte> out) {
        if (stream_.avail_in == 0 && !refill()) ends_early();
        const std::size_t room = std::min(out.size(), kMaxPerCall);
        stream_.next_out = reinterpret_cast<Bytef*>(out.data());
        stream_.avail_out = static_cast<uInt>(room);
        const int status = inflate(&stream_, Z_NO_FLUSH);
        if (status == Z_MEM_ERROR) out_of_memory();
        if (status == Z_STREAM_END) {
            finished_ = !next_member();
        } else if (status != Z_OK && status != Z_BUF_ERROR) {
            corrupt();
        }
        return room - stream_.avail_out;
    }

    /// gzip files may hold several streams in a row (bgzip, pigz, cat); other bytes after the end are counted by payload_bytes(), except
    /// zero padding.
    bool next_member() {
        if (!gzip_) return false;
        if (stream_.avail_in < 2) refill();
        const auto* next = reinterpret_cast<const std::byte*>(stream_.next_in);
        if (!starts_like_gzip({next, stream_.avail_in})) return false;
        inflateReset(&stream_);
        return true;
    }

    /// The bytes that follow the stream in its part of the file; 0 when they are all zero: padding.
    std::int64_t bytes_behind() {
        const std::int64_t behind = end_ - (next_read_ - stream_.avail_in);
        while (stream_.avail_in > 0 || refill()) {
            if (std::any_of(stream_.next_in, stream_.next_in + stream_.avail_in, [](Bytef byte) { return byte != 0; })) return behind;
            stream_.avail_in = 0;
        }
        return 0;
    }

    std::string here() const { return "offset " + std::to_string(next_read_ - stream_.avail_in); }
    [[noreturn]] void ends_early() const {
        throw Error(ErrorKind::input, {.file = path_,
                                       .where = here(),
                                       .what = "the file ends early, inside its compressed data",
                                       .next = "the file is truncated: get it again"});
    }
    [[noreturn]] void corrupt() const {
        const std::string reason = stream_.msg != nullptr ? std::string(" (") + stream_.msg + ")" : "";
        throw Error(ErrorKind::input, {.file = path_,
                                       .where = here(),
                                       .what = "the compressed data are corrupt" + reason,
                                       .expected = "a gzip or zlib stream",
                                       .next = "the file is damaged: get it again"});
    }
    [[noreturn]] void out_of_memory() const {
        throw Error(ErrorKind::resource, {.file = path_, .what = "not enough memory to decompress", .next = "free some memory"});
    }

    std::string path_;
    std::unique_ptr<File> file_;
    std::int64_t begin_ = 0, end_ = 0;  // of the compressed bytes in the file
    std::int64_t next_read_ = 0;        // offset in the file after the buffer
    std::int64_t position_ = 0;         // in the decompressed stream
    bool finished_ = false;
    bool gzip_ = false;
    Inflater stream_;
    std::vector<std::byte> buffer_;
};

}  // namespace

std::unique_ptr<ByteSource> open_inflate_source(const std::string& path, std::int64_t offset, std::int64_t length) {
    return std::make_unique<InflateSource>(path, offset, length);
}

std::int64_t inflated_bytes(const std::string& path, std::int64_t offset, std::int64_t length, std::int64_t max) {
    return InflateSource(path, offset, length).decoded_bytes(max);
}

std::vector<std::byte> read_inflated_bytes(const std::string& path, std::int64_t max) {
    InflateSource source(path, 0, -1);
    std::vector<std::byte> bytes(static_cast<std::size_t>(std::min(max, source.size_bound())));
    bytes.resize(source.read_some(bytes));
    return bytes;
}

}  // namespace isoatlas
