#include "formats/common/block_inflater.h"

#include <algorithm>
#include <new>

#include "base/check.h"

namespace isoatlas {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 16;
constexpr std::size_t kMaxPerBlock = std::size_t{1} << 30;  // zlib counts in 32 bits

std::string reason(int status) { return status == Z_BUF_ERROR ? "it ends early" : zError(status); }

}  // namespace

BlockInflater::BlockInflater() : buffer_(kBlockBytes) {
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
}

BlockInflater::~BlockInflater() { inflateEnd(&stream_); }

void BlockInflater::start(std::int64_t compressed, std::int64_t bytes) {
    inflateReset(&stream_);
    stream_.avail_in = 0;
    unread_ = compressed;
    bytes_ = bytes;
    position_ = 0;
}

std::string BlockInflater::read(ByteSource& source, std::span<std::byte> out) {
    ISOATLAS_CHECK(static_cast<std::int64_t>(out.size()) <= bytes_ - position_);
    while (!out.empty()) {
        std::size_t count = 0;
        const int status = inflate_some(source, out, count);
        out = out.subspan(count);
        position_ += static_cast<std::int64_t>(count);
        if (status == Z_STREAM_END && position_ == bytes_) return "";
        if (status == Z_STREAM_END) return "it is too short";
        if (status != Z_OK) return reason(status);
    }
    return position_ == bytes_ ? finish(source) : "";
}

std::string BlockInflater::finish(ByteSource& source) {
    for (;;) {
        std::byte more{};
        std::size_t count = 0;
        const int status = inflate_some(source, {&more, 1}, count);
        if (count > 0) return "it is too long";
        if (status == Z_STREAM_END) return "";
        if (status != Z_OK) return reason(status);
    }
}

/// One call of zlib. count: bytes it produced. Returns Z_BUF_ERROR when the block has no more bytes.
int BlockInflater::inflate_some(ByteSource& source, std::span<std::byte> out, std::size_t& count) {
    if (stream_.avail_in == 0 && unread_ > 0) {
        const auto bytes = static_cast<std::size_t>(std::min<std::int64_t>(unread_, kBlockBytes));
        source.read(std::span(buffer_).first(bytes));
        unread_ -= static_cast<std::int64_t>(bytes);
        stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
        stream_.avail_in = static_cast<uInt>(bytes);
    }
    const std::size_t room = std::min(out.size(), kMaxPerBlock);
    stream_.next_out = reinterpret_cast<Bytef*>(out.data());
    stream_.avail_out = static_cast<uInt>(room);
    const int status = inflate(&stream_, Z_NO_FLUSH);
    count = room - stream_.avail_out;
    return status == Z_BUF_ERROR && unread_ > 0                                    ? Z_OK
           : status == Z_OK && count == 0 && unread_ == 0 && stream_.avail_in == 0 ? Z_BUF_ERROR
                                                                                   : status;
}

}  // namespace isoatlas
