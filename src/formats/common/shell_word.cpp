#include "isoatlas/shell_word.h"

#include "isoatlas/text.h"

namespace isoatlas {
namespace {

/// Inside $'...': unprintable bytes as three octal digits.
std::string ansi_quoted(const std::string& word) {
    std::string text;
    for (const char c : word) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte >= 0x7f) {
            text += '\\';
            for (int shift = 6; shift >= 0; shift -= 3) text += static_cast<char>('0' + (byte >> shift & 7));
        } else {
            if (c == '\\' || c == '\'') text += '\\';
            text += c;
        }
    }
    return text;
}

}  // namespace

std::string shell_word(const std::string& word) {
    constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    if (shown_name(word) != word) return "$'" + ansi_quoted(word) + "'";
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace isoatlas
