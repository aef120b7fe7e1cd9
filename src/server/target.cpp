#include "server/target.h"

#include <algorithm>
#include <charconv>

namespace isoatlas {
namespace {

std::string decoded(std::string_view text, bool plus_is_space) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned code = 0;
        if (text[i] == '%' && i + 2 < text.size()) {
            const auto [end, error] = std::from_chars(text.data() + i + 1, text.data() + i + 3, code, 16);
            if (error == std::errc() && end == text.data() + i + 3) {
                result += static_cast<char>(code);
                i += 2;
                continue;
            }
        }
        result += plus_is_space && text[i] == '+' ? ' ' : text[i];
    }
    return result;
}

}  // namespace

Target target_of(std::string_view text) {
    const std::size_t mark = text.find('?');
    Target target{decoded(text.substr(0, mark), false), {}};
    std::string_view rest = mark == std::string_view::npos ? std::string_view() : text.substr(mark + 1);
    while (!rest.empty()) {
        const std::string_view word = rest.substr(0, rest.find('&'));
        rest.remove_prefix(std::min(word.size() + 1, rest.size()));
        const std::size_t equal = word.find('=');
        if (word.empty()) continue;
        target.words.emplace(decoded(word.substr(0, equal), true),
                             equal == std::string_view::npos ? std::string() : decoded(word.substr(equal + 1), true));
    }
    return target;
}

VolumeTarget volume_target_of(std::string_view target) {
    constexpr std::string_view kVolume = "/volume/";
    constexpr std::size_t kMaxDigits = 9;
    if (!target.starts_with(kVolume)) return {{}, {}, target};
    const std::size_t end = target.find('/', kVolume.size());
    const std::string_view digits = target.substr(kVolume.size(), end == std::string_view::npos ? end : end - kVolume.size());
    std::int64_t number = 0;
    const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool is_number = error == std::errc() && last == digits.data() + digits.size() && number >= 0 && digits.size() <= kMaxDigits;
    if (end == std::string_view::npos || !is_number) return {{}, {}, target};
    return {number, target.substr(0, end), target.substr(end)};
}

}  // namespace isoatlas
