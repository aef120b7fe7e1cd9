#include "output/json_stream.h"

#include <ostream>

#include "isoatlas/error.h"

namespace isoatlas::output {

namespace {

/// Length of the well-formed UTF-8 sequence at the start of text; 0: none (also for overlong forms, surrogates, beyond U+10FFFF).
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

}  // namespace

void JsonStream::quote(std::string_view text) {
    constexpr std::string_view kHex = "0123456789abcdef";
    text_ += '"';
    while (!text.empty()) {
        const auto c = static_cast<unsigned char>(text[0]);
        const std::size_t length = utf8_length(text);
        if (length == 0) {
            text_ += "\\ufffd";  // not UTF-8 (a path may hold anything): the replacement character
        } else if (c == '"' || c == '\\') {
            text_ += '\\';
            text_ += text[0];
        } else if (c < 0x20) {
            text_ += "\\u00";
            text_ += kHex[c >> 4];
            text_ += kHex[c & 15];
        } else {
            text_ += text.substr(0, length);
        }
        text.remove_prefix(length == 0 ? 1 : length);
    }
    text_ += '"';
}

JsonStream::Sink stream_sink(std::ostream& out, const char* what) {
    return [&out, what](std::string_view text) {
        if (out.write(text.data(), static_cast<std::streamsize>(text.size()))) return;
        throw Error(ErrorKind::resource,
                    {.what = std::string(what) + " cannot be written to its stream", .next = "free some space, or write it to a file"});
    };
}

}  // namespace isoatlas::output
