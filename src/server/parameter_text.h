// Values of query parameters: texts that are numbers as a whole, and refusals that show them shortened.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "isoatlas/error.h"

namespace isoatlas {

/// Of a stranger's text so much is repeated.
inline constexpr std::size_t kLongestShown = 60;

[[noreturn]] inline void refuse_parameter(std::string_view name, std::string_view text, const std::string& expected) {
    throw Error(
        ErrorKind::usage,
        {.where = std::string(name), .what = "'" + std::string(text.substr(0, kLongestShown)) + "' is not valid", .expected = expected});
}

/// The whole text is a number.
template <class Number>
[[nodiscard]] std::optional<Number> whole_text_as(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace isoatlas
