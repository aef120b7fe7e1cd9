#include "formats/common/text_source.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>

#include "formats/common/text.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kChunkBytes = 64 * 1024;
constexpr std::size_t kLongestWord = 1100;  // more than the 1077 characters of the longest exact double in plain notation

bool is_separator(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f' || c == ','; }

template <class T>
bool parse_sample(std::string_view word, std::byte* out) {
    if (word.starts_with('+')) word.remove_prefix(1);
    T value{};
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) return false;
    if (error == std::errc::result_out_of_range) {
        if constexpr (std::is_floating_point_v<T>) {
            value = static_cast<T>(std::strtod(std::string(word).c_str(), nullptr));  // rounds to zero, a subnormal or infinity
        } else {
            return false;
        }
    }
    std::memcpy(out, &value, sizeof(T));
    return true;
}

bool parse_sample(std::string_view word, ValueType type, WideInteger wide, std::byte* out) {
    if (wide == WideInteger::int64) return parse_sample<std::int64_t>(word, out);
    if (wide == WideInteger::uint64) return parse_sample<std::uint64_t>(word, out);
    switch (type) {
        case ValueType::u8: return parse_sample<std::uint8_t>(word, out);
        case ValueType::i8: return parse_sample<std::int8_t>(word, out);
        case ValueType::u16: return parse_sample<std::uint16_t>(word, out);
        case ValueType::i16: return parse_sample<std::int16_t>(word, out);
        case ValueType::u32: return parse_sample<std::uint32_t>(word, out);
        case ValueType::i32: return parse_sample<std::int32_t>(word, out);
        case ValueType::f32: return parse_sample<float>(word, out);
        case ValueType::f64: break;
    }
    return parse_sample<double>(word, out);
}

class TextSource final : public ByteSource {
public:
    TextSource(std::unique_ptr<ByteSource> text, ValueType type, TextEnd end, WideInteger wide)
        : text_(std::move(text)),
          type_(type),
          end_(end),
          wide_(wide),
          sample_bytes_(static_cast<std::int64_t>(size_of(type))),
          text_bytes_(text_->size_bound()) {}

    void read(std::span<std::byte> out) override {  // whole samples: readers request only those
        for (std::size_t done = 0; done < out.size(); done += static_cast<std::size_t>(sample_bytes_)) next_sample(out.data() + done);
    }
    void seek(std::int64_t offset) override {
        const std::int64_t sample = offset / sample_bytes_;
        if (sample < samples_read_) restart();
        std::byte ignored[8];
        while (samples_read_ < sample) next_sample(ignored);
    }
    std::int64_t payload_bytes(std::int64_t max) override {
        std::byte ignored[8];
        for (skip_separators(); !is_at_end(); skip_separators()) {
            if (samples_read_ > max / sample_bytes_) return max + 1;
            next_sample(ignored);
        }
        return samples_read_ * sample_bytes_;
    }
    bool random_access() const override { return false; }
    std::int64_t size_bound() const override {
        const std::int64_t samples = text_bytes_ / 2 + 1;
        return samples > std::numeric_limits<std::int64_t>::max() / 8 ? std::numeric_limits<std::int64_t>::max() : samples * sample_bytes_;
    }
    const std::string& file() const override { return text_->file(); }

private:
    void restart() {
        text_->seek(0);
        consumed_ = 0;
        samples_read_ = 0;
        chunk_.clear();
        at_ = 0;
    }
    bool refill() {
        const std::int64_t bytes = std::min(kChunkBytes, text_bytes_ - consumed_);
        if (bytes == 0) return false;
        chunk_.resize(static_cast<std::size_t>(bytes));
        text_->read(std::as_writable_bytes(std::span(chunk_)));
        consumed_ += bytes;
        at_ = 0;
        return true;
    }
    void skip_separators() {
        while (at_ < chunk_.size() || refill()) {
            if (!is_separator(chunk_[at_])) return;
            ++at_;
        }
    }
    void next_sample(std::byte* out) {
        skip_separators();
        word_.clear();
        while ((at_ < chunk_.size() || refill()) && !is_separator(chunk_[at_]) && word_.size() < kLongestWord) word_ += chunk_[at_++];
        if (word_.empty()) fail("the text ends early", "one more number");
        if (is_at_end() && end_ == TextEnd::separator) {
            fail("the text ends with " + in_quotes(word_) + ", which may be the beginning of a longer number", "a line end after it",
                 "the file is truncated: get it again; if it is whole, add a line end");
        }
        if (!parse_sample(word_, type_, wide_, out))
            fail(in_quotes(word_) + " is not a sample", std::string("a ") + type_name() + " number");
        ++samples_read_;
    }
    [[nodiscard]] const char* type_name() const { return wide_ == WideInteger::none ? name_of(type_) : name_of(wide_); }
    [[nodiscard]] bool is_at_end() const { return at_ == chunk_.size() && consumed_ == text_bytes_; }
    [[noreturn]] void fail(const std::string& what, const std::string& expected,
                           const std::string& next = "the file is truncated or damaged: get it again") const {
        throw Error(ErrorKind::input, {.file = file(),
                                       .where = "number " + std::to_string(samples_read_ + 1) + " of the samples",
                                       .what = what,
                                       .expected = expected,
                                       .next = next});
    }

    std::unique_ptr<ByteSource> text_;
    ValueType type_;
    TextEnd end_;
    WideInteger wide_;
    std::int64_t sample_bytes_;
    std::int64_t text_bytes_;
    std::int64_t consumed_ = 0;  // characters read into chunks
    std::int64_t samples_read_ = 0;
    std::string chunk_, word_;
    std::size_t at_ = 0;  // in chunk_
};

}  // namespace

std::unique_ptr<ByteSource> open_text_source(std::unique_ptr<ByteSource> text, ValueType type, TextEnd end, WideInteger wide) {
    return std::make_unique<TextSource>(std::move(text), type, end, wide);
}

}  // namespace isoatlas
