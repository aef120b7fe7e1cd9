#include "formats/common/bzip2_source.h"

#include <bzlib.h>

#include <string_view>

#include "formats/common/compressed_source.h"

namespace isoatlas {
namespace {

class Bunzip final : public StreamDecoder {
public:
    Bunzip() = default;
    Bunzip(const Bunzip&) = delete;
    Bunzip& operator=(const Bunzip&) = delete;
    ~Bunzip() override { end(); }

    bool start(std::span<const std::byte>) override {
        end();
        stream_ = {};
        started_ = ::BZ2_bzDecompressInit(&stream_, /*verbosity=*/0, /*small=*/0) == BZ_OK;
        return started_;
    }
    bool follows(std::span<const std::byte> begin) const override {
        const std::string_view text(reinterpret_cast<const char*>(begin.data()), begin.size());
        return text.size() >= 4 && text.starts_with("BZh") && text[3] >= '1' && text[3] <= '9';
    }
    Step decode(std::span<const std::byte> in, std::span<std::byte> out) override {
        stream_.next_in = reinterpret_cast<char*>(const_cast<std::byte*>(in.data()));
        stream_.avail_in = static_cast<unsigned>(in.size());
        stream_.next_out = reinterpret_cast<char*>(out.data());
        stream_.avail_out = static_cast<unsigned>(out.size());
        status_ = ::BZ2_bzDecompress(&stream_);
        return {result(), in.size() - stream_.avail_in, out.size() - stream_.avail_out};
    }
    std::string reason() const override {
        return status_ == BZ_DATA_ERROR_MAGIC ? "it does not begin as bzip2 does" : "a damaged block or a wrong checksum";
    }
    const char* expected() const override { return "a bzip2 stream"; }
    std::int64_t max_ratio() const override { return std::int64_t{1} << 21; }

private:
    [[nodiscard]] Result result() const {
        if (status_ == BZ_STREAM_END) return Result::end;
        if (status_ == BZ_MEM_ERROR) return Result::no_memory;
        return status_ == BZ_OK ? Result::more : Result::damaged;
    }
    void end() {
        if (started_) ::BZ2_bzDecompressEnd(&stream_);
        started_ = false;
    }

    bz_stream stream_{};
    bool started_ = false;
    int status_ = BZ_OK;
};

}  // namespace

std::vector<std::byte> read_bunzipped_bytes(const std::string& path, std::int64_t max) {
    return CompressedSource(path, 0, -1, std::make_unique<Bunzip>()).read_some(max);
}

std::unique_ptr<ByteSource> open_bzip2_source(const std::string& path, std::int64_t offset, std::int64_t length) {
    return std::make_unique<CompressedSource>(path, offset, length, std::make_unique<Bunzip>());
}

}  // namespace isoatlas
