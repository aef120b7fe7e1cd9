#include "formats/volume/byte_rle_source.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "base/check.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBufferBytes = std::int64_t{1} << 16;
constexpr int kLiteral = 128, kLongestRun = 127;

class ByteRleSource final : public ByteSource {
public:
    explicit ByteRleSource(std::unique_ptr<ByteSource> packed)
        : packed_(std::move(packed)), packed_bytes_(packed_->size_bound()), buffer_(static_cast<std::size_t>(kBufferBytes)) {
        ISOATLAS_CHECK(packed_->random_access());
        restart();
    }

    void read(std::span<std::byte> out) override {
        const std::size_t got = read_some(out);
        if (got == out.size()) return;
        fail("the run-length coded samples end early", std::to_string(out.size() - got) + " more bytes");
    }
    void seek(std::int64_t offset) override {
        if (offset < position_) restart();
        std::array<std::byte, 16384> scratch;
        while (position_ < offset)
            read(std::span(scratch).first(static_cast<std::size_t>(std::min<std::int64_t>(scratch.size(), offset - position_))));
    }
    std::int64_t payload_bytes(std::int64_t max) override {
        std::array<std::byte, 65536> scratch;
        while (position_ <= max) {
            const auto room = static_cast<std::size_t>(std::min<std::int64_t>(scratch.size(), max - position_ + 1));
            if (read_some(std::span(scratch).first(room)) < room) break;
        }
        return position_;
    }
    bool random_access() const override { return false; }
    std::int64_t size_bound() const override {
        constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
        return std::min(packed_bytes_ / 2 + 1, kMax / kLongestRun) * kLongestRun;
    }
    const std::string& file() const override { return packed_->file(); }

private:
    void restart() {
        packed_->seek(0);
        fetched_ = position_ = 0;
        at_ = filled_ = run_ = 0;
    }
    bool is_at_end() const { return at_ == filled_ && fetched_ == packed_bytes_; }

    /// Ensures that a packed byte is there.
    void fetch() {
        if (at_ < filled_) return;
        if (fetched_ == packed_bytes_) fail("the run-length coded samples end inside a run", "its bytes");
        filled_ = static_cast<std::size_t>(std::min(kBufferBytes, packed_bytes_ - fetched_));
        packed_->read(std::span(buffer_).first(filled_));
        fetched_ += static_cast<std::int64_t>(filled_);
        at_ = 0;
    }
    std::byte next() {
        fetch();
        return buffer_[at_++];
    }

    /// Up to out.size() bytes; fewer at the end of the packed bytes.
    std::size_t read_some(std::span<std::byte> out) {
        std::size_t done = 0;
        while (done < out.size()) {
            if (run_ == 0) {
                if (is_at_end()) break;
                const int code = std::to_integer<int>(next());
                is_literal_ = code >= kLiteral;
                run_ = static_cast<std::size_t>(is_literal_ ? code - kLiteral : code);
                if (!is_literal_) repeated_ = next();
                continue;
            }
            std::size_t count = std::min(run_, out.size() - done);
            if (is_literal_) {
                fetch();
                count = std::min(count, filled_ - at_);
                std::memcpy(out.data() + done, buffer_.data() + at_, count);
                at_ += count;
            } else {
                std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(done), count, repeated_);
            }
            run_ -= count;
            done += count;
        }
        position_ += static_cast<std::int64_t>(done);
        return done;
    }

    [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
        throw Error(ErrorKind::input, {.file = file(),
                                       .where = "byte " + std::to_string(position_) + " of the decoded samples",
                                       .what = what,
                                       .expected = expected,
                                       .next = "the file is truncated or damaged: get it again"});
    }

    std::unique_ptr<ByteSource> packed_;
    std::int64_t packed_bytes_, fetched_ = 0, position_ = 0;
    std::vector<std::byte> buffer_;
    std::size_t at_ = 0, filled_ = 0, run_ = 0;
    std::byte repeated_{};
    bool is_literal_ = false;
};

}  // namespace

std::unique_ptr<ByteSource> open_byte_rle_source(std::unique_ptr<ByteSource> packed) {
    return std::make_unique<ByteRleSource>(std::move(packed));
}

}  // namespace isoatlas
