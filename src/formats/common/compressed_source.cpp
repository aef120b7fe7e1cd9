#include "formats/common/compressed_source.h"

#include <algorithm>
#include <array>
#include <limits>

#include "formats/common/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kStreamBytes = 256 * 1024;
constexpr std::size_t kMaxPerCall = 1U << 30;  // zlib and libbz2 count in 32 bits
constexpr std::size_t kMagicBytes = 4;         // that tell whether another stream follows

}  // namespace

CompressedSource::CompressedSource(const std::string& path, std::int64_t offset, std::int64_t length,
                                   std::unique_ptr<StreamDecoder> decoder)
    : path_(path), file_(open_file(path)), decoder_(std::move(decoder)) {
    const std::int64_t file_bytes = file_->size();
    if (offset < 0 || offset >= file_bytes || length > file_bytes - offset) {
        throw Error(ErrorKind::input,
                    {.file = path,
                     .where = "offset " + std::to_string(offset),
                     .what = "the file ends before its compressed samples do: it has " + std::to_string(file_bytes) + " bytes",
                     .expected = length < 0 ? decoder_->expected() : std::to_string(length) + " compressed bytes",
                     .next = "the file is truncated or its header is wrong: get it again"});
    }
    begin_ = offset;
    end_ = length < 0 ? file_bytes : offset + length;
    buffer_.resize(static_cast<std::size_t>(std::min(kStreamBytes, end_ - begin_)));
    restart();
}

CompressedSource::~CompressedSource() = default;

void CompressedSource::read(std::span<std::byte> out) {
    const std::size_t got = read_some(out);
    if (got == out.size()) return;
    throw Error(ErrorKind::input, {.file = path_,
                                   .where = "byte " + std::to_string(position_) + " of the decompressed data",
                                   .what = "the compressed data end early",
                                   .expected = std::to_string(out.size() - got) + " more bytes",
                                   .next = "the file is truncated or its header claims too much: get it again"});
}

void CompressedSource::seek(std::int64_t offset) {
    if (offset < position_) restart();
    std::array<std::byte, 16384> scratch;
    while (position_ < offset) {
        read(std::span(scratch).first(static_cast<std::size_t>(std::min<std::int64_t>(scratch.size(), offset - position_))));
    }
}

std::int64_t CompressedSource::payload_bytes(std::int64_t max) {
    const std::int64_t inside = decoded_bytes(max), behind = finished_ ? bytes_behind() : 0;
    return inside > max || behind > max - inside ? max + 1 : inside + behind;
}

std::int64_t CompressedSource::size_bound() const {
    const std::int64_t ratio = decoder_->max_ratio(), limit = std::numeric_limits<std::int64_t>::max() / ratio;
    return std::min(end_ - begin_, limit) * ratio;
}

std::size_t CompressedSource::read_some(std::span<std::byte> out) {
    std::size_t done = 0;
    while (done < out.size() && !finished_) done += decode_once(out.subspan(done));
    position_ += static_cast<std::int64_t>(done);
    return done;
}

std::vector<std::byte> CompressedSource::read_some(std::int64_t max) {
    std::vector<std::byte> bytes(static_cast<std::size_t>(std::min(max, size_bound())));
    bytes.resize(read_some(std::span(bytes)));
    return bytes;
}

std::int64_t CompressedSource::decoded_bytes(std::int64_t max) {
    std::array<std::byte, 65536> scratch;
    while (!finished_ && position_ <= max) {
        const auto room = std::min(static_cast<std::int64_t>(scratch.size()), max - position_ + 1);
        (void)read_some(std::span(scratch).first(static_cast<std::size_t>(room)));
    }
    return position_;
}

void CompressedSource::restart() {
    unread_ = {};
    next_read_ = begin_;
    position_ = 0;
    finished_ = false;
    refill();
    if (!decoder_->start(unread_)) out_of_memory();
}

/// Keeps the unread bytes of the buffer and appends bytes of the file; false at the end of the file.
bool CompressedSource::refill() {
    if (next_read_ == end_) return false;
    const std::size_t kept = unread_.size();
    std::copy(unread_.begin(), unread_.end(), buffer_.begin());
    const auto room = static_cast<std::int64_t>(buffer_.size() - kept);
    const auto bytes = static_cast<std::size_t>(std::min(room, end_ - next_read_));
    read_fully(*file_, path_, next_read_, std::span(buffer_).subspan(kept, bytes));
    next_read_ += static_cast<std::int64_t>(bytes);
    unread_ = std::span<const std::byte>(buffer_).first(kept + bytes);
    return true;
}

/// One call of the library; the number of bytes it produced.
std::size_t CompressedSource::decode_once(std::span<std::byte> out) {
    const bool at_end = unread_.empty() && !refill();
    const StreamDecoder::Step step = decoder_->decode(unread_, out.first(std::min(out.size(), kMaxPerCall)));
    unread_ = unread_.subspan(step.read);
    switch (step.result) {
        case StreamDecoder::Result::end: finished_ = !another_stream(); break;
        case StreamDecoder::Result::damaged: corrupt();
        case StreamDecoder::Result::no_memory: out_of_memory();
        case StreamDecoder::Result::more:
            if (at_end && step.written == 0) ends_early();
    }
    return step.written;
}

/// Several streams in a row are one (bgzip, pigz, pbzip2, cat); other bytes after the end are counted by payload_bytes(), except zero
/// padding.
bool CompressedSource::another_stream() {
    if (unread_.size() < kMagicBytes) refill();
    if (!decoder_->follows(unread_)) return false;
    if (!decoder_->start(unread_)) out_of_memory();
    return true;
}

/// The bytes that follow the stream in its part of the file; 0 when they are all zero: padding.
std::int64_t CompressedSource::bytes_behind() {
    const std::int64_t behind = end_ - (next_read_ - static_cast<std::int64_t>(unread_.size()));
    while (!unread_.empty() || refill()) {
        if (std::any_of(unread_.begin(), unread_.end(), [](std::byte byte) { return byte != std::byte{0}; })) return behind;
        unread_ = {};
    }
    return 0;
}

std::string CompressedSource::here() const { return "offset " + std::to_string(next_read_ - static_cast<std::int64_t>(unread_.size())); }

void CompressedSource::ends_early() const {
    throw Error(ErrorKind::input, {.file = path_,
                                   .where = here(),
                                   .what = "the file ends early, inside its compressed data",
                                   .next = "the file is truncated: get it again"});
}

void CompressedSource::corrupt() const {
    const std::string reason = decoder_->reason();
    throw Error(ErrorKind::input, {.file = path_,
                                   .where = here(),
                                   .what = "the compressed data are corrupt" + (reason.empty() ? "" : " (" + reason + ")"),
                                   .expected = decoder_->expected(),
                                   .next = "the file is damaged: get it again"});
}

void CompressedSource::out_of_memory() const {
    throw Error(ErrorKind::resource, {.file = path_, .what = "not enough memory to decompress", .next = "free some memory"});
}

}  // namespace isoatlas
