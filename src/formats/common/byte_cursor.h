// ByteCursor: parses an untrusted file in memory. Every step is checked against the remaining bytes; errors name the position.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "formats/common/text.h"
#include "isoatlas/error.h"

namespace isoatlas {

inline constexpr const char* kDamagedFile = "the file is damaged or cut off: copy or export it again";

class ByteCursor {
public:
    /// `file` must outlive the cursor.
    ByteCursor(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
    [[nodiscard]] const std::string& file() const { return file_; }
    void go_to(std::size_t offset) { at_ = std::min(offset, bytes_.size()); }

    [[nodiscard]] std::string_view bytes(std::size_t count, const char* of_what) {
        if (left() < count) {
            fail_at_offset("the file ends inside " + std::string(of_what),
                           std::to_string(count) + " bytes, " + std::to_string(left()) + " are left");
        }
        at_ += count;
        return bytes_.substr(at_ - count, count);
    }
    template <class T>
    [[nodiscard]] T number(bool big_endian, const char* of_what) {
        char raw[sizeof(T)];
        std::memcpy(raw, bytes(sizeof(T), of_what).data(), sizeof(T));
        if (big_endian) std::reverse(raw, raw + sizeof(T));
        T value;
        std::memcpy(&value, raw, sizeof(T));
        return value;
    }
    /// The rest of the line without its end (LF, CRLF or CR); empty at the end of the file.
    [[nodiscard]] std::string_view line() {
        const std::size_t end = std::min(bytes_.find_first_of("\r\n", at_), bytes_.size());
        const std::string_view text = bytes_.substr(at_, end - at_);
        at_ = end;
        if (left() > 1 && bytes_.substr(at_, 2) == "\r\n") ++at_;
        if (left() > 0) ++at_;
        return text;
    }
    /// The next word between white space; empty at the end of the file.
    [[nodiscard]] std::string_view word() {
        while (left() > 0 && is_space(bytes_[at_])) ++at_;
        const std::size_t begin = at_;
        while (left() > 0 && !is_space(bytes_[at_])) ++at_;
        return bytes_.substr(begin, at_ - begin);
    }
    [[noreturn]] void fail_at_offset(std::string what, std::string expected = {}, std::string next = kDamagedFile) const {
        throw Error(ErrorKind::input, {file_, "offset " + std::to_string(at_), std::move(what), std::move(expected), std::move(next)});
    }
    [[noreturn]] void fail_at_line(std::string what, std::string expected = {}, std::string next = kDamagedFile) const {
        const std::size_t end = at_ > 0 ? at_ - 1 : 0;
        const auto lines = std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(end), '\n');
        throw Error(ErrorKind::input, {file_, "line " + std::to_string(lines + 1), std::move(what), std::move(expected), std::move(next)});
    }
    [[nodiscard]] static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

private:
    std::string_view bytes_;
    const std::string& file_;
    std::size_t at_ = 0;
};

/// The whole word as a number; false when it is not a number or does not fit.
template <class T>
[[nodiscard]] bool parse_number(std::string_view word, T& value) {
    if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
}

/// Removes and returns the first word of a line; empty when there is none.
[[nodiscard]] inline std::string_view take_word(std::string_view& line) {
    const std::size_t begin = std::min(line.find_first_not_of(" \t\v\f"), line.size());
    const std::size_t end = std::min(line.find_first_of(" \t\v\f", begin), line.size());
    const std::string_view word = line.substr(begin, end - begin);
    line.remove_prefix(end);
    return word;
}

}  // namespace isoatlas
