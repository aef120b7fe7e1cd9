#include "formats/common/gzip_stream.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "base/check.h"
#include "isoatlas/error.h"

namespace isoatlas {

namespace {

constexpr int kLevel = 4;             ///< labels: half the time of level 6 for a few percent more bytes
constexpr int kGzipWindow = 15 + 16;  ///< 32 KiB window, gzip header without name and time
constexpr int kMemory = 8;
constexpr std::size_t kOutBytes = std::size_t{1} << 16;

}  // namespace

struct GzipStream::State {
    z_stream stream{};
    std::vector<std::byte> out = std::vector<std::byte>(kOutBytes);
};

GzipStream::GzipStream(Sink& sink) : sink_(sink), state_(std::make_unique<State>()) {
    if (deflateInit2(&state_->stream, kLevel, Z_DEFLATED, kGzipWindow, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) {
        throw Error(ErrorKind::resource, {.file = sink.name(), .what = "not enough memory to compress", .next = "close other programs"});
    }
}

GzipStream::~GzipStream() { deflateEnd(&state_->stream); }

void GzipStream::write(std::span<const std::byte> bytes) {
    z_stream& stream = state_->stream;
    while (!bytes.empty()) {
        const std::size_t count = std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max());
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data()));  // zlib only reads
        stream.avail_in = static_cast<uInt>(count);
        while (stream.avail_in > 0) run(Z_NO_FLUSH);
        bytes = bytes.subspan(count);
    }
}

void GzipStream::finish() { run(Z_FINISH); }

/// Compresses the buffered bytes; with Z_FINISH to the end of the stream.
void GzipStream::run(int flush) {
    z_stream& stream = state_->stream;
    int result = Z_OK;
    do {
        stream.next_out = reinterpret_cast<Bytef*>(state_->out.data());
        stream.avail_out = static_cast<uInt>(state_->out.size());
        result = deflate(&stream, flush);
        ISOATLAS_CHECK(result != Z_STREAM_ERROR);
        sink_.write(std::span<const std::byte>(state_->out).first(state_->out.size() - stream.avail_out));
    } while (flush == Z_FINISH && result != Z_STREAM_END);
}

}  // namespace isoatlas
