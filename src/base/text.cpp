#include "isoatlas/text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace isoatlas {
namespace {

/// Length of the well-formed UTF-8 sequence at the start of text, which is not empty; 0: none.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    const auto follows = [&](std::size_t i) { return (byte(i) & 0xc0U) == 0x80U; };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    if (first >= 0xc2 && first <= 0xdf) return follows(1) ? 2 : 0;
    if (first >= 0xe0 && first <= 0xef) {
        const bool bad = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) >= 0xa0);
        return !bad && follows(1) && follows(2) ? 3 : 0;
    }
    if (first >= 0xf0 && first <= 0xf4) {
        const bool bad = (first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) >= 0x90);
        return !bad && follows(1) && follows(2) && follows(3) ? 4 : 0;
    }
    return 0;
}

void append_escaped(std::string& text, unsigned char byte) {
    constexpr std::string_view kHex = "0123456789abcdef";
    text += "\\x";
    text += kHex[byte >> 4];
    text += kHex[byte & 15];
}

/// Windows-1252: its 32 characters between ASCII and Latin-1; 0: none.
constexpr std::array<std::uint16_t, 32> kWindows = {0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
                                                    0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
                                                    0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178};

void append_windows(std::string& text, unsigned char byte) {
    if (byte < 0x80) {
        text += static_cast<char>(byte);
        return;
    }
    const unsigned code = byte < 0xa0 ? kWindows[byte - 0x80U] : byte;
    if (code == 0) return append_escaped(text, byte);
    if (code >= 0x800) text += static_cast<char>(0xe0U | code >> 12);
    text += static_cast<char>(code >= 0x800 ? 0x80U | (code >> 6 & 0x3fU) : 0xc0U | code >> 6);
    text += static_cast<char>(0x80U | (code & 0x3fU));
}

/// Of UTF-8: U+0000 to U+001F, U+007F, and U+0080 to U+009F, which terminals understand as well.
bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character[0]);
    if (character.size() == 2) return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
    return first < 0x20 || first == 0x7f;
}

/// Escapes bytes that are not UTF-8 and the characters that `bad` says.
template <class Bad>
std::string escaped(std::string_view text, const Bad& bad) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const std::size_t length = utf8_length(text), taken = std::max<std::size_t>(length, 1);
        const std::string_view character = text.substr(0, taken);
        if (length > 0 && !bad(character)) {
            result += character;
        } else {
            append_escaped(result, static_cast<unsigned char>(character.back()));
        }
        text.remove_prefix(taken);
    }
    return result;
}

}  // namespace

bool is_utf8(std::string_view bytes) {
    while (!bytes.empty()) {
        const std::size_t length = utf8_length(bytes);
        if (length == 0) return false;
        bytes.remove_prefix(length);
    }
    return true;
}

std::string decoded_text(std::string_view bytes) {
    if (is_utf8(bytes)) return std::string(bytes);
    std::string text;
    for (const char c : bytes) append_windows(text, static_cast<unsigned char>(c));
    return text;
}

std::string header_text(std::string_view bytes, bool lines) {
    return escaped(decoded_text(bytes), [lines](std::string_view c) { return is_control(c) && !(lines && (c == "\n" || c == "\t")); });
}

std::string written_name(std::string_view name) {
    return escaped(name, [](std::string_view) { return false; });
}

std::string shown_name(std::string_view name) { return escaped(name, is_control); }

std::string_view utf8_prefix(std::string_view text, std::size_t max) {
    if (text.size() <= max) return text;
    std::size_t end = max;
    while (end > 0 && max - end < 3 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) --end;
    return text.substr(0, end);
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, change}));
        }
    }
    return row.back();
}

}  // namespace isoatlas
