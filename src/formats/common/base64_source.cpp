#include "formats/common/base64_source.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <vector>

#include "formats/common/base64.h"
#include "formats/common/file_access.h"
#include "formats/common/text.h"
#include "isoatlas/error.h"

namespace isoatlas {

namespace {

constexpr std::size_t kTextBytes = std::size_t{1} << 16;

constexpr signed char kBlank = -1, kPadding = -2, kEnd = -3, kBad = -4;

constexpr std::array<signed char, 256> kCodes = [] {
    std::array<signed char, 256> table{};
    table.fill(kBad);
    for (std::size_t i = 0; i < kBase64Digits.size(); ++i)
        table[static_cast<unsigned char>(kBase64Digits[i])] = static_cast<signed char>(i);
    table[' '] = table['\t'] = table['\r'] = table['\n'] = kBlank;
    table['='] = kPadding, table['<'] = kEnd;
    return table;
}();

class Base64Source final : public ByteSource {
public:
    Base64Source(std::unique_ptr<File> file, const std::string& path, std::int64_t begin, std::int64_t end)
        : path_(path), file_(std::move(file)), begin_(begin), end_(std::min(end, file_->size())), next_(begin), text_(kTextBytes) {}

    void read(std::span<std::byte> out) override {
        while (!out.empty()) {
            require_more(static_cast<std::int64_t>(out.size()));
            const std::size_t count = std::min(out.size(), ready_.size() - taken_);
            std::memcpy(out.data(), ready_.data() + taken_, count);
            out = out.subspan(count);
            take(count);
        }
    }
    void seek(std::int64_t offset) override {
        if (offset < position_) restart();
        while (position_ < offset) {
            require_more(offset - position_);
            take(static_cast<std::size_t>(std::min(static_cast<std::int64_t>(ready_.size() - taken_), offset - position_)));
        }
    }
    std::int64_t payload_bytes(std::int64_t max) override {
        while (position_ <= max && decode_more()) take(ready_.size() - taken_);
        return std::min(position_, max + 1);
    }
    bool random_access() const override { return false; }
    std::int64_t size_bound() const override { return std::max<std::int64_t>(end_ - begin_, 0) / 4 * 3; }
    const std::string& file() const override { return path_; }

private:
    [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
        throw Error(ErrorKind::input, {.file = path_,
                                       .where = "offset " + std::to_string(next_),
                                       .what = what,
                                       .expected = expected,
                                       .next = "the file is damaged or truncated: get it again"});
    }
    void require_more(std::int64_t wanted) {
        if (!decode_more()) fail("the base64 data end early", std::to_string(wanted) + " more bytes");
    }
    void take(std::size_t count) {
        taken_ += count;
        position_ += static_cast<std::int64_t>(count);
        if (taken_ < ready_.size()) return;
        ready_.clear();
        taken_ = 0;
    }
    void restart() {
        next_ = begin_;
        position_ = 0;
        taken_ = 0;
        ready_.clear();
        start_group();
    }
    void start_group() {
        bits_ = 0;
        count_ = 0;
        padding_ = 0;
    }

    /// Ensures decoded bytes by decoding the next piece of text if necessary. False at the end.
    bool decode_more() {
        while (ready_.empty() && next_ < end_) {
            const auto wanted = static_cast<std::size_t>(std::min<std::int64_t>(end_ - next_, kTextBytes));
            read_fully(*file_, path_, next_, std::span(text_).first(wanted));
            next_ += static_cast<std::int64_t>(wanted);
            decode({reinterpret_cast<const char*>(text_.data()), wanted});
            if (next_ >= end_ && count_ != 0) fail("the base64 text ends inside a group of four", "a multiple of 4 characters");
        }
        return !ready_.empty();
    }
    void decode(std::string_view text) {
        for (const char c : text) {
            const signed char code = kCodes[static_cast<unsigned char>(c)];
            if (code == kBlank) continue;
            if (code == kEnd) {
                end_ = next_;  // the text ends in this piece
                return;
            }
            if (code == kBad) fail("a character is not base64: " + in_quotes(std::string_view(&c, 1)), "A-Z a-z 0-9 + / =");
            take_code(code);
        }
    }
    void take_code(signed char code) {
        if (code == kPadding) ++padding_;
        if (padding_ > 2 || (code != kPadding && padding_ > 0)) fail("'=' stands inside a group of base64", "at most two, at its end");
        bits_ = bits_ << 6 | static_cast<std::uint32_t>(code == kPadding ? 0 : code);
        if (++count_ < 4) return;
        for (int i = 0; i < 3 - padding_; ++i) ready_.push_back(static_cast<std::byte>(bits_ >> (16 - 8 * i)));
        start_group();
    }

    std::string path_;
    std::unique_ptr<File> file_;
    std::int64_t begin_, end_;
    std::int64_t next_;  ///< offset in the file after the decoded text
    std::vector<std::byte> text_;
    std::vector<std::byte> ready_;  ///< decoded bytes
    std::size_t taken_ = 0;         ///< of ready_
    std::int64_t position_ = 0;     ///< in the decoded stream
    std::uint32_t bits_ = 0;        ///< the current group: 6 bits a character
    int count_ = 0, padding_ = 0;
};

}  // namespace

std::unique_ptr<ByteSource> open_base64_source(std::unique_ptr<File> file, const std::string& path, std::int64_t begin, std::int64_t end) {
    return std::make_unique<Base64Source>(std::move(file), path, begin, end);
}

}  // namespace isoatlas
