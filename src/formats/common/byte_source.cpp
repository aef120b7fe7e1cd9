#include "formats/common/byte_source.h"

#include <algorithm>
#include <limits>

#include "formats/common/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

/// The part of a file that a source reads; length -1 means to the end.
std::int64_t checked_length(const std::string& path, std::int64_t file_bytes, std::int64_t offset, std::int64_t length) {
    if (offset < 0 || offset > file_bytes || length > file_bytes - offset) {
        throw Error(ErrorKind::input, {.file = path,
                                       .where = "offset " + std::to_string(offset),
                                       .what = "the file ends early: it has " + std::to_string(file_bytes) + " bytes",
                                       .expected = length < 0 ? "samples" : std::to_string(length) + " bytes",
                                       .next = "the file is truncated or its header is wrong: get it again"});
    }
    return length < 0 ? file_bytes - offset : length;
}

class FileSource final : public ByteSource {
public:
    FileSource(std::unique_ptr<File> file, const std::string& path, std::int64_t offset, std::int64_t length)
        : path_(path), file_(std::move(file)), offset_(offset), length_(checked_length(path, file_->size(), offset, length)) {}

    void read(std::span<std::byte> out) override {
        const auto wanted = static_cast<std::int64_t>(out.size());
        if (wanted > length_ - position_) ends_early(wanted);
        read_fully(*file_, path_, offset_ + position_, out);
        position_ += wanted;
    }
    void seek(std::int64_t offset) override {
        if (offset < 0 || offset > length_) ends_early(0);
        position_ = offset;
    }
    std::int64_t payload_bytes(std::int64_t max) override { return max < length_ ? max + 1 : length_; }
    bool random_access() const override { return true; }
    std::int64_t size_bound() const override { return length_; }
    const std::string& file() const override { return path_; }

private:
    [[noreturn]] void ends_early(std::int64_t wanted) const {
        throw Error(ErrorKind::input, {.file = path_,
                                       .where = "offset " + std::to_string(offset_ + length_),
                                       .what = "the file ends early",
                                       .expected = std::to_string(wanted) + " bytes from offset " + std::to_string(offset_ + position_),
                                       .next = "the file is truncated: get it again"});
    }

    std::string path_;
    std::unique_ptr<File> file_;
    std::int64_t offset_, length_;
    std::int64_t position_ = 0;
};

class PartsSource final : public ByteSource {
public:
    explicit PartsSource(PartsPlan plan) : plan_(std::move(plan)) {}

    void read(std::span<std::byte> out) override {
        while (!out.empty()) {
            const std::int64_t part = position_ / plan_.part_bytes;
            const std::int64_t inside = position_ - part * plan_.part_bytes;
            if (part >= plan_.count) ends_early(out.size());
            if (part != open_part_) {
                end_part();
                current_ = plan_.open(part);
                open_part_ = part;
            }
            const auto bytes = static_cast<std::size_t>(std::min(static_cast<std::int64_t>(out.size()), plan_.part_bytes - inside));
            current_->seek(inside);
            current_->read(out.first(bytes));
            out = out.subspan(bytes);
            position_ += static_cast<std::int64_t>(bytes);
        }
    }
    void seek(std::int64_t offset) override { position_ = offset; }
    std::int64_t payload_bytes(std::int64_t) override {  // only the open part can have unread bytes
        end_part();
        return plan_.count * plan_.part_bytes;
    }
    bool random_access() const override { return plan_.random_access; }
    std::int64_t size_bound() const override { return plan_.size_bound; }
    const std::string& file() const override { return plan_.file; }

private:
    [[noreturn]] void ends_early(std::size_t wanted) const {
        throw Error(ErrorKind::input, {.file = plan_.file,
                                       .where = "after data file " + std::to_string(plan_.count),
                                       .what = "the data files end early",
                                       .expected = std::to_string(wanted) + " more bytes"});
    }

    /// Reads the open part to its end, because its checksum is there.
    void end_part() {
        if (open_part_ >= 0) (void)require_end(*current_, plan_.part_bytes, plan_.skip_rest);
        open_part_ = -1;
    }

    PartsPlan plan_;
    std::unique_ptr<ByteSource> current_;
    std::int64_t open_part_ = -1;
    std::int64_t position_ = 0;
};

}  // namespace

std::unique_ptr<ByteSource> open_file_source(const std::string& path, std::int64_t offset, std::int64_t length) {
    return open_file_source(open_file(path), path, offset, length);
}

std::unique_ptr<ByteSource> open_file_source(std::unique_ptr<File> file, const std::string& path, std::int64_t offset,
                                             std::int64_t length) {
    return std::make_unique<FileSource>(std::move(file), path, offset, length);
}

std::unique_ptr<ByteSource> open_parts_source(PartsPlan plan) { return std::make_unique<PartsSource>(std::move(plan)); }

void refuse_rest(const std::string& file, std::int64_t rest) {
    throw Error(ErrorKind::input,
                {.file = file,
                 .where = "after the samples",
                 .what = std::to_string(rest) + (rest == 1 ? " byte follows" : " bytes follow"),
                 .expected = "the end of the data",
                 .next = "the header or the file is damaged, or it holds more than a volume: then let the rest be skipped",
                 .reason = Reason::bytes_after_samples});
}

std::int64_t require_end(ByteSource& source, std::int64_t wanted, bool skip_rest) {
    constexpr std::int64_t kTimes = 16, kMax = std::numeric_limits<std::int64_t>::max() / (kTimes + 2);
    const std::int64_t max = source.random_access() ? std::numeric_limits<std::int64_t>::max() - 1
                                                    : wanted + std::max(kMaxRest, std::min(wanted, kMax) * kTimes);
    const std::int64_t found = source.payload_bytes(max);
    if (found < wanted) {
        throw Error(ErrorKind::input, {.file = source.file(),
                                       .where = "samples",
                                       .what = "the data end after " + std::to_string(found) + " bytes",
                                       .expected = std::to_string(wanted) + " bytes",
                                       .next = "the file is truncated or its header is wrong: get it again"});
    }
    if (found > max) {
        throw Error(ErrorKind::input, {.file = source.file(),
                                       .where = "after the samples",
                                       .what = "more than " + std::to_string(max - wanted) + " decompressed bytes follow",
                                       .expected = std::to_string(wanted) + " bytes of samples",
                                       .next = "the header is wrong, or the file is made to fill memory or time: do not use it"});
    }
    if (found > wanted && !skip_rest) refuse_rest(source.file(), found - wanted);
    return found - wanted;
}

std::int64_t file_size(const std::string& path) { return open_file(path)->size(); }

std::vector<std::byte> read_header_bytes(const std::string& path, std::int64_t max) {
    const std::unique_ptr<File> file = open_file(path);
    std::vector<std::byte> bytes(static_cast<std::size_t>(std::min(max, file->size())));
    bytes.resize(read_available(*file, path, 0, bytes));
    return bytes;
}

bool starts_like_gzip(std::span<const std::byte> bytes) {
    return bytes.size() >= 2 && bytes[0] == std::byte{0x1f} && bytes[1] == std::byte{0x8b};
}

}  // namespace isoatlas
