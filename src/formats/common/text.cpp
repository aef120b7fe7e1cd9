#include "formats/common/text.h"

#include <bit>
#include <charconv>
#include <filesystem>
#include <functional>
#include <numeric>

#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr std::string_view kSpace = " \t\r\n\v\f";
constexpr std::size_t kLongestQuote = 60;

template <class Number>
std::optional<Number> parse_whole(std::string_view word) {
    if (word.starts_with('+')) {
        word.remove_prefix(1);
        if (word.starts_with('-')) return std::nullopt;
    }
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || word.empty()) return std::nullopt;
    return value;
}

}  // namespace

std::string_view trim(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(kSpace);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

std::vector<std::string_view> split_words(std::string_view text) {
    std::vector<std::string_view> words;
    for (std::size_t begin = text.find_first_not_of(kSpace); begin != std::string_view::npos;
         begin = text.find_first_not_of(kSpace, begin)) {
        const std::size_t end = std::min(text.find_first_of(kSpace, begin), text.size());
        words.push_back(text.substr(begin, end - begin));
        begin = end;
    }
    return words;
}

std::optional<std::int64_t> parse_integer(std::string_view word) { return parse_whole<std::int64_t>(word); }
std::optional<double> parse_number(std::string_view word) { return parse_whole<double>(word); }

bool ends_with_ignoring_case(std::string_view text, std::string_view end) {
    return text.size() >= end.size() && lower(text.substr(text.size() - end.size())) == lower(end);
}

bool is_damaged(std::string_view word, std::string_view known) {
    const auto was_blank = [](char c) { return std::popcount(static_cast<unsigned>(static_cast<unsigned char>(c) ^ ' ')) == 1; };
    if (word.size() == known.size() + 1)
        return (word.starts_with(known) && was_blank(word.back())) || (word.ends_with(known) && was_blank(word.front()));
    return word.size() == known.size() &&
           std::inner_product(word.begin(), word.end(), known.begin(), 0, std::plus<>(), std::not_equal_to<>()) == 1;
}

std::string printable(std::string_view text) { return header_text(text); }

std::string in_quotes(std::string_view text) {
    const std::string shown = printable(text);
    return "'" + std::string(utf8_prefix(shown, kLongestQuote)) + (shown.size() > kLongestQuote ? "...'" : "'");
}

std::string beside(const std::string& path, std::string_view name) {
    return (std::filesystem::path(path).parent_path() / std::filesystem::path(name)).string();
}

}  // namespace isoatlas
