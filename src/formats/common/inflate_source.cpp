// gzip and zlib streams.
#include <zlib.h>

#include "formats/common/compressed_source.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaximalRatio = 1032;  // zlib's documentation: the limit of the deflate format
constexpr int kDetectGzipOrZlib = 15 + 32;    // windowBits: largest window, the stream's header decides

class Inflater final : public StreamDecoder {
public:
    Inflater() = default;
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() override { inflateEnd(&stream_); }

    bool start(std::span<const std::byte> begin) override {
        gzip_ = starts_like_gzip(begin);
        return stream_.state == nullptr ? inflateInit2(&stream_, kDetectGzipOrZlib) == Z_OK
                                        : inflateReset2(&stream_, kDetectGzipOrZlib) == Z_OK;
    }
    bool follows(std::span<const std::byte> begin) const override { return gzip_ && starts_like_gzip(begin); }
    Step decode(std::span<const std::byte> in, std::span<std::byte> out) override {
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(in.data()));
        stream_.avail_in = static_cast<uInt>(in.size());
        stream_.next_out = reinterpret_cast<Bytef*>(out.data());
        stream_.avail_out = static_cast<uInt>(out.size());
        const int status = inflate(&stream_, Z_NO_FLUSH);
        return {result_of(status), in.size() - stream_.avail_in, out.size() - stream_.avail_out};
    }
    std::string reason() const override { return stream_.msg != nullptr ? stream_.msg : ""; }
    const char* expected() const override { return "a gzip or zlib stream"; }
    std::int64_t max_ratio() const override { return kMaximalRatio; }

private:
    static Result result_of(int status) {
        if (status == Z_STREAM_END) return Result::end;
        if (status == Z_MEM_ERROR) return Result::no_memory;
        return status == Z_OK || status == Z_BUF_ERROR ? Result::more : Result::damaged;
    }

    z_stream stream_{};
    bool gzip_ = false;
};

CompressedSource inflate_source(const std::string& path, std::int64_t offset, std::int64_t length) {
    return {path, offset, length, std::make_unique<Inflater>()};
}

}  // namespace

std::unique_ptr<ByteSource> open_inflate_source(const std::string& path, std::int64_t offset, std::int64_t length) {
    return std::make_unique<CompressedSource>(path, offset, length, std::make_unique<Inflater>());
}

std::int64_t inflated_bytes(const std::string& path, std::int64_t offset, std::int64_t length, std::int64_t max) {
    return inflate_source(path, offset, length).decoded_bytes(max);
}

std::vector<std::byte> read_inflated_bytes(const std::string& path, std::int64_t max) { return inflate_source(path, 0, -1).read_some(max); }

}  // namespace isoatlas
