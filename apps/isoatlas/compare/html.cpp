#include "compare/html.h"

#include <array>

#include <isoatlas/text.h>

namespace isoatlas::cli {
namespace {

constexpr double kQuality = 92;  // chroma is kept at half the resolution: thin red lines need the rest

std::string base64(const std::vector<std::byte>& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? static_cast<unsigned>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

/// The text between two marks becomes an element.
std::string with_element(const std::string& text, char mark, const std::string& element) {
    std::string html;
    std::size_t at = 0;
    for (;;) {
        const std::size_t begin = text.find(mark, at), end = begin == std::string::npos ? begin : text.find(mark, begin + 1);
        if (end == std::string::npos) return html + text.substr(at);
        html += text.substr(at, begin - at) + "<" + element + ">" + text.substr(begin + 1, end - begin - 1) + "</" + element + ">";
        at = end + 1;
    }
}

std::string without_links(std::string text) {
    for (std::size_t middle; (middle = text.find("](")) != std::string::npos;) {
        const std::size_t begin = text.rfind('[', middle), end = text.find(')', middle);
        if (begin == std::string::npos || end == std::string::npos) return text;
        text = text.substr(0, begin) + text.substr(begin + 1, middle - begin - 1) + text.substr(end + 1);
    }
    return text;
}

}  // namespace

std::string html_text(std::string_view text) {
    std::string safe;
    for (const char c : written_name(text)) {
        switch (c) {
            case '<': safe += "&lt;"; break;
            case '>': safe += "&gt;"; break;
            case '&': safe += "&amp;"; break;
            case '"': safe += "&quot;"; break;
            default: safe += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
        }
    }
    return safe;
}

std::string html_of_markdown(std::string_view paragraph) {
    return with_element(with_element(html_text(without_links(std::string(paragraph))), '`', "code"), '*', "em");
}

std::string data_address(const Image& image) {
    Animation still;
    still.frames.push_back(image);
    return "data:image/webp;base64," + base64(encode_webp(still, kQuality));
}

}  // namespace isoatlas::cli
