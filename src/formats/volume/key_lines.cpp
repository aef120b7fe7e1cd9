#include "formats/volume/key_lines.h"

#include <algorithm>
#include <cmath>

#include "formats/common/byte_source.h"
#include "formats/common/header_text.h"
#include "formats/common/text.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaxLinesBytes = std::int64_t{1} << 20;

bool is_comment(std::string_view line) { return line.empty() || line.starts_with('#') || line.starts_with("//"); }

/// Key and value of a line; an empty key for any other line.
std::pair<std::string_view, std::string_view> split_pair(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return {};
    return {trim(line.substr(0, colon)), trim(line.substr(colon + 1))};
}

}  // namespace

KeyLines::KeyLines(const std::string& path, std::span<const std::string_view> known) : path_(path) {
    const std::vector<std::byte> bytes = read_header_bytes(path, kMaxLinesBytes + 1);
    if (static_cast<std::int64_t>(bytes.size()) > kMaxLinesBytes)
        throw Error(ErrorKind::input, {.file = path, .what = "the header is longer than 1 MiB", .next = "get the file again"});
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    int number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::string_view line = trim(take_line(text, begin));
        ++number;
        if (is_comment(line)) continue;
        const auto [key, value] = split_pair(line);
        if (key.empty()) {
            throw Error(ErrorKind::input, {.file = path,
                                           .where = "line " + std::to_string(number),
                                           .what = in_quotes(line) + " is not a line of such a header",
                                           .expected = "'KEY: value'",
                                           .next = "the header is damaged: get the file again or correct it"});
        }
        const std::string name = lower(key);
        const bool is_known = std::ranges::find(known, name) != known.end();
        for (const std::string_view other : known) {
            if (!is_known && is_damaged(name, other)) fail(ErrorKind::input, key, "is not a known key", std::string(other));
        }
        lines_.emplace_back(key, value);
    }
}

void KeyLines::fail(ErrorKind kind, std::string_view key, const std::string& what, const std::string& expected,
                    const std::string& next) const {
    const auto line = std::ranges::find_if(lines_, [&](const auto& pair) { return lower(pair.first) == lower(key); });
    throw Error(kind, {.file = path_,
                       .where = "key " + printable(line == lines_.end() ? key : std::string_view(line->first)),
                       .what = what,
                       .expected = expected,
                       .next = next});
}

std::vector<std::string> KeyLines::all(std::string_view key) const {
    std::vector<std::string> values;
    for (const auto& [name, value] : lines_) {
        if (lower(name) == lower(key)) values.push_back(value);
    }
    return values;
}

std::string KeyLines::text(std::string_view key) const {
    const std::vector<std::string> values = all(key);
    if (values.size() > 1) fail(ErrorKind::input, key, "is there " + std::to_string(values.size()) + " times", "one line");
    return values.empty() ? std::string() : values[0];
}

std::optional<std::vector<double>> KeyLines::numbers(std::string_view key, std::size_t count) const {
    const std::string value = text(key);
    if (value.empty()) return std::nullopt;
    std::vector<double> result;
    for (const std::string_view word : split_words(value)) {
        const std::optional<double> number = parse_number(word);
        if (!number || !std::isfinite(*number)) fail(ErrorKind::input, key, in_quotes(word) + " is not a number", "a number");
        result.push_back(*number);
    }
    if (result.size() != count) fail(ErrorKind::input, key, "has " + std::to_string(result.size()) + " numbers", std::to_string(count));
    return result;
}

std::optional<std::vector<std::int64_t>> KeyLines::integers(std::string_view key, std::size_t count) const {
    const std::string value = text(key);
    if (value.empty()) return std::nullopt;
    std::vector<std::int64_t> result;
    for (const std::string_view word : split_words(value)) {
        const std::optional<std::int64_t> number = parse_integer(word);
        if (!number) fail(ErrorKind::input, key, in_quotes(word) + " is not a whole number", "a whole number");
        result.push_back(*number);
    }
    if (result.size() != count) fail(ErrorKind::input, key, "has " + std::to_string(result.size()) + " numbers", std::to_string(count));
    return result;
}

std::int64_t KeyLines::offset(std::string_view key) const {
    const std::optional<std::vector<std::int64_t>> found = integers(key, 1);
    if (!found) return 0;
    if ((*found)[0] < 0) fail(ErrorKind::input, key, "is negative", "a number of bytes");
    return (*found)[0];
}

bool has_key_line(std::string_view text, std::span<const std::string_view> keys) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::string_view line = trim(take_line(text, begin));
        if (is_comment(line)) continue;
        const std::string name = lower(split_pair(line).first);
        if (name.empty()) return false;  // not such a file
        if (std::ranges::find(keys, name) != keys.end()) return true;
    }
    return false;
}

}  // namespace isoatlas
