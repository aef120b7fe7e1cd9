// Parses words and numbers of text headers. Numbers are independent of the locale and must span the whole word.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isoatlas {

[[nodiscard]] std::string_view trim(std::string_view text);                      ///< without blanks, tabs and line ends around it
[[nodiscard]] std::string lower(std::string_view text);                          ///< ASCII only
[[nodiscard]] std::vector<std::string_view> split_words(std::string_view text);  ///< at white space, views into text
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);  ///< nullopt: not an integer or out of range
[[nodiscard]] std::optional<double> parse_number(std::string_view word);         ///< also nan and inf
[[nodiscard]] bool ends_with_ignoring_case(std::string_view text, std::string_view end);
/// Whether `word` may be a known one with a flipped bit: one character differs, or there is one more at an end (it was a blank).
[[nodiscard]] bool is_damaged(std::string_view word, std::string_view known);
/// The text as UTF-8, with control characters escaped: header texts are shown on terminals and written into files.
[[nodiscard]] std::string printable(std::string_view text);
/// printable() in quotes, shortened, for messages.
[[nodiscard]] std::string in_quotes(std::string_view text);
/// "a, b, c", and ", ..." where there are more than a message should name. Shown: what a message says of each, as text.
template <class List, class Shown>
[[nodiscard]] std::string first_of(const List& list, const Shown& shown) {
    constexpr std::size_t kMost = 20;
    std::string text;
    std::size_t count = 0;
    for (const auto& one : list) {
        if (count == kMost) return text + ", ...";
        if (count++ > 0) text += ", ";
        text += std::invoke(shown, one);
    }
    return text;
}
/// `name` beside `path`: names are relative to the folder of the header that contains them.
[[nodiscard]] std::string beside(const std::string& path, std::string_view name);

}  // namespace isoatlas
