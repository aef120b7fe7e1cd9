// JsonStream: writes a JSON document incrementally, without keeping it in memory. Numbers are the shortest that read back as the same
// value.
//
//   JsonStream json([&](std::string_view text) { out << text; });
//   json.begin_object().key("tau").value(1.5).key("ids").begin_array().value(std::int64_t{7}).end_array().end_object().finish();
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "isoatlas/sink.h"

namespace isoatlas {

class JsonStream {
public:
    using Output = std::function<void(std::string_view)>;
    explicit JsonStream(Output output) : output_(std::move(output)) {}

    JsonStream& begin_object() { return open('{'); }
    JsonStream& end_object() { return close('}'); }
    JsonStream& begin_array() { return open('['); }
    JsonStream& end_array() { return close(']'); }
    JsonStream& key(std::string_view name) {
        separate();
        quote(name);
        text_ += ':';
        after_key_ = true;
        return *this;
    }
    /// JSON has no infinity and no NaN: they become null.
    JsonStream& value(double number) { return std::isfinite(number) ? put_number(number) : null(); }
    template <std::integral T>
        requires(!std::same_as<T, bool>)
    JsonStream& value(T number) {
        return put_number(number);
    }
    JsonStream& value(bool truth) { return put(truth ? "true" : "false"); }
    JsonStream& value(std::string_view text) {
        separate();
        quote(text);
        return flush_when_long();
    }
    JsonStream& value(const char* text) { return value(std::string_view(text)); }
    JsonStream& null() { return put("null"); }
    template <class T, std::size_t N>
    JsonStream& value(const std::array<T, N>& numbers) {
        begin_array();
        for (const T number : numbers) value(number);
        return end_array();
    }
    /// The next item starts on a new line.
    JsonStream& line() {
        new_line_ = true;
        return *this;
    }
    void finish() {
        text_ += '\n';
        output_(text_);
        text_.clear();
    }

private:
    static constexpr std::size_t kFlushBytes = 1 << 16;

    void separate() {
        if (!after_key_ && !is_first_.empty()) {
            if (!is_first_.back()) text_ += ',';
            is_first_.back() = false;
            if (new_line_) text_ += '\n';
        }
        after_key_ = new_line_ = false;
    }
    JsonStream& open(char bracket) {
        separate();
        text_ += bracket;
        is_first_.push_back(true);
        return *this;
    }
    JsonStream& close(char bracket) {
        if (new_line_) text_ += '\n';
        new_line_ = false;
        text_ += bracket;
        is_first_.pop_back();
        return flush_when_long();
    }
    JsonStream& put(std::string_view word) {
        separate();
        text_ += word;
        return flush_when_long();
    }
    template <class T>
    JsonStream& put_number(T number) {
        std::array<char, 40> digits;
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
        return put(std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data())));
    }
    JsonStream& flush_when_long() {
        if (text_.size() >= kFlushBytes) {
            output_(text_);
            text_.clear();
        }
        return *this;
    }
    void quote(std::string_view text);

    Output output_;
    std::string text_;
    std::vector<bool> is_first_;  ///< per open object or array: still empty
    bool after_key_ = false, new_line_ = false;
};

[[nodiscard]] inline JsonStream::Output output_to(Sink& sink) {
    return [&sink](std::string_view text) { sink.write(text); };
}
/// `what`: "the tree"; for the message of the Error{resource} thrown when the stream fails.
[[nodiscard]] JsonStream::Output output_to(std::ostream& out, const char* what);

}  // namespace isoatlas
