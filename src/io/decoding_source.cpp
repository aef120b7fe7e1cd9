#include "io/decoding_source.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <limits>
#include <type_traits>

#include "io/file_access.h"
#include "io/text.h"

namespace isoatlas::io {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

/// Bytes that come out of the text in pieces.
class DecodingSource : public ByteSource {
public:
    DecodingSource(const std::string& path, std::int64_t begin, std::int64_t end)
        : path_(path), file_(open_file(path)), begin_(begin), end_(std::min(end, file_->size())), next_(begin), text_(kBufferBytes) {}

    void read(std::span<std::byte> out) override {
        while (!out.empty()) {
            if (ready_.empty() && !decode_more()) {
                fail("the data end early", std::to_string(out.size()) + " more bytes");
            }
            const std::size_t count = std::min(out.size(), ready_.size() - taken_);
            std::memcpy(out.data(), ready_.data() + taken_, count);
            out = out.subspan(count);
            take(count);
        }
    }
    void seek(std::int64_t offset) override {
        if (offset < position_) restart();
        while (position_ < offset) {
            if (ready_.empty() && !decode_more()) fail("the data end early", std::to_string(offset - position_) + " more bytes");
            take(static_cast<std::size_t>(std::min(static_cast<std::int64_t>(ready_.size() - taken_), offset - position_)));
        }
    }
    bool at_end() override { return ready_.empty() && !decode_more(); }
    bool random_access() const override { return false; }
    const std::string& file() const override { return path_; }

protected:
    /// Appends to ready_ what the next characters of the text stand for; nothing at its end.
    virtual void decode(std::string_view text, bool last) = 0;
    virtual void reset() = 0;
    [[nodiscard]] std::int64_t text_bytes() const { return std::max<std::int64_t>(end_ - begin_, 0); }
    [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
        throw Error(ErrorKind::input, {.file = path_, .where = "offset " + std::to_string(next_), .what = what, .expected = expected,
                                       .next = "the file is damaged or truncated: get it again"});
    }
    void finish() { end_ = next_; }   ///< nothing behind the current text belongs to the data

    std::vector<std::byte> ready_;

private:
    void take(std::size_t count) {
        taken_ += count;
        position_ += static_cast<std::int64_t>(count);
        if (taken_ < ready_.size()) return;
        ready_.clear();
        taken_ = 0;
    }
    bool decode_more() {
        while (ready_.empty() && !ended_) {
            const auto wanted = static_cast<std::size_t>(std::clamp<std::int64_t>(end_ - next_, 0, kBufferBytes));
            read_fully(*file_, path_, next_, std::span(text_).first(wanted));
            next_ += static_cast<std::int64_t>(wanted);
            ended_ = next_ >= end_;
            decode({reinterpret_cast<const char*>(text_.data()), wanted}, ended_);
            ended_ = next_ >= end_;
        }
        return !ready_.empty();
    }
    void restart() {
        next_ = begin_;
        position_ = 0;
        taken_ = 0;
        ended_ = false;
        ready_.clear();
        reset();
    }

    std::string path_;
    std::unique_ptr<FileHandle> file_;
    std::int64_t begin_, end_;
    std::int64_t next_;          ///< offset in the file behind the text read so far
    std::int64_t position_ = 0;  ///< in the decoded bytes
    std::size_t taken_ = 0;      ///< of ready_
    bool ended_ = false;
    std::vector<std::byte> text_;
};

constexpr signed char kBlank = -1, kPadding = -2, kEnd = -3, kBad = -4;

constexpr std::array<signed char, 256> kBase64 = [] {
    std::array<signed char, 256> table{};
    table.fill(kBad);
    for (int i = 0; i < 26; ++i) {
        table[static_cast<std::size_t>('A' + i)] = static_cast<signed char>(i);
        table[static_cast<std::size_t>('a' + i)] = static_cast<signed char>(26 + i);
    }
    for (int i = 0; i < 10; ++i) table[static_cast<std::size_t>('0' + i)] = static_cast<signed char>(52 + i);
    table['+'] = 62, table['/'] = 63;
    table[' '] = table['\t'] = table['\r'] = table['\n'] = kBlank;
    table['='] = kPadding, table['<'] = kEnd;
    return table;
}();

class Base64Source final : public DecodingSource {
public:
    using DecodingSource::DecodingSource;
    std::int64_t size_bound() const override { return text_bytes() / 4 * 3 + 3; }

private:
    void decode(std::string_view text, bool last) override {
        for (const char c : text) {
            const signed char code = kBase64[static_cast<unsigned char>(c)];
            if (code == kBlank) continue;
            if (code == kEnd) {
                finish();
                last = true;
                break;
            }
            if (code == kBad) fail("a character is not base64: " + quoted(std::string_view(&c, 1)), "A-Z a-z 0-9 + / =");
            take_code(code);
        }
        if (last && count_ != 0) fail("the base64 text ends inside a group of four", "a multiple of 4 characters");
    }
    void take_code(signed char code) {
        if (code == kPadding) {
            ++padding_;
        } else if (padding_ > 0) {
            fail("the base64 text goes on behind '=' inside a group of four", "'='");
        }
        bits_ = bits_ << 6 | static_cast<std::uint32_t>(code == kPadding ? 0 : code);
        if (++count_ < 4) return;
        if (padding_ > 2) fail("a group of base64 is padding only", "at most two '='");
        for (int i = 0; i < 3 - padding_; ++i) ready_.push_back(static_cast<std::byte>(bits_ >> (16 - 8 * i)));
        reset();
    }
    void reset() override {
        bits_ = 0;
        count_ = 0;
        padding_ = 0;
    }

    std::uint32_t bits_ = 0;   ///< the last four codes
    int count_ = 0, padding_ = 0;
};

template <class T>
class AsciiSource final : public DecodingSource {
public:
    using DecodingSource::DecodingSource;
    /// A number and the blank behind it take two characters at least.
    std::int64_t size_bound() const override { return (text_bytes() + 1) / 2 * static_cast<std::int64_t>(sizeof(T)); }

private:
    static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

    void decode(std::string_view text, bool last) override {
        for (const char c : text) {
            if (!is_blank(c)) {
                if (word_.size() >= 400) fail("a word is too long for a number: " + quoted(word_), "a number");
                word_ += c;
            } else if (!word_.empty()) {
                put_word();
            }
        }
        if (last && !word_.empty()) put_word();
    }
    void put_word() {
        T value{};
        const char* begin = word_.data() + (word_.starts_with('+') && word_.size() > 1 ? 1 : 0);
        const char* end = word_.data() + word_.size();
        const auto [stop, error] = std::from_chars(begin, end, value);
        bool good = error == std::errc{} && stop == end;
        if constexpr (std::is_floating_point_v<T>) {
            if (error == std::errc::result_out_of_range && stop == end) good = take_tiny(begin, end, value);
        }
        if (!good) fail("not a number of type " + std::string(name_of(value_type_of<T>)) + ": " + quoted(word_), "a number");
        const auto bytes = std::as_bytes(std::span(&value, 1));
        ready_.insert(ready_.end(), bytes.begin(), bytes.end());
        word_.clear();
    }
    /// Numbers too small for the type (from_chars calls them out of range like those that are too large) become zero or subnormal.
    static bool take_tiny(const char* begin, const char* end, T& value) {
        double wide = 0;
        const std::string_view word(begin, static_cast<std::size_t>(end - begin));
        const bool is_tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
        if (std::from_chars(begin, end, wide).ec != std::errc{} && !is_tiny) return false;
        if (wide > static_cast<double>(std::numeric_limits<T>::max()) || wide < static_cast<double>(std::numeric_limits<T>::lowest())) return false;
        value = static_cast<T>(wide);
        return true;
    }
    void reset() override { word_.clear(); }

    std::string word_;
};

}  // namespace

std::unique_ptr<ByteSource> open_base64_source(const std::string& path, std::int64_t begin, std::int64_t end) {
    return std::make_unique<Base64Source>(path, begin, end);
}

std::unique_ptr<ByteSource> open_ascii_source(const std::string& path, std::int64_t begin, std::int64_t end, ValueType type) {
    switch (type) {
        case ValueType::u8: return std::make_unique<AsciiSource<std::uint8_t>>(path, begin, end);
        case ValueType::i8: return std::make_unique<AsciiSource<std::int8_t>>(path, begin, end);
        case ValueType::u16: return std::make_unique<AsciiSource<std::uint16_t>>(path, begin, end);
        case ValueType::i16: return std::make_unique<AsciiSource<std::int16_t>>(path, begin, end);
        case ValueType::u32: return std::make_unique<AsciiSource<std::uint32_t>>(path, begin, end);
        case ValueType::i32: return std::make_unique<AsciiSource<std::int32_t>>(path, begin, end);
        case ValueType::f32: return std::make_unique<AsciiSource<float>>(path, begin, end);
        case ValueType::f64: break;
    }
    return std::make_unique<AsciiSource<double>>(path, begin, end);
}

}  // namespace isoatlas::io
