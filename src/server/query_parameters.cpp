#include "server/query_parameters.h"

#include <algorithm>
#include <cmath>

#include "formats/common/byte_writer.h"
#include "isoatlas/error.h"
#include "server/parameter_text.h"

namespace isoatlas {
namespace {

std::int64_t whole_in(std::string_view name, std::string_view text, std::int64_t min, std::int64_t max) {
    const std::optional<std::int64_t> number = whole_text_as<std::int64_t>(text);
    if (!number || *number < min || *number > max)
        refuse_parameter(name, text, "a whole number from " + std::to_string(min) + " to " + std::to_string(max));
    return *number;
}

}  // namespace

std::optional<std::string_view> QueryParameters::take(std::string_view name) {
    known_.push_back(name);
    const auto [begin, end] = words_.equal_range(std::string(name));
    if (begin == end) return std::nullopt;
    if (std::next(begin) != end) refuse_parameter(name, begin->second, "one value");
    return begin->second;
}

std::optional<double> QueryParameters::number(std::string_view name) {
    const std::optional<std::string_view> text = take(name);
    if (!text) return std::nullopt;
    const std::optional<double> number = whole_text_as<double>(*text);
    if (!number || !std::isfinite(*number)) refuse_parameter(name, *text, "a finite number");
    return number;
}

std::optional<double> QueryParameters::number(std::string_view name, double min) {
    const std::optional<double> any = number(name);
    if (any && *any < min) refuse_parameter(name, words_.find(std::string(name))->second, "a number from " + number_text(min) + " on");
    return any;
}

double QueryParameters::required_tau() {
    const std::optional<double> tau = number("tau");
    if (!tau) throw Error(ErrorKind::usage, {.where = "tau", .what = "missing isovalue", .next = "add tau=NUMBER"});
    return *tau;
}

std::optional<std::int64_t> QueryParameters::whole(std::string_view name, std::int64_t min, std::int64_t max) {
    const std::optional<std::string_view> text = take(name);
    if (!text) return std::nullopt;
    return whole_in(name, *text, min, max);
}

std::optional<std::string> QueryParameters::choice(std::string_view name, const std::vector<std::string_view>& choices) {
    const std::optional<std::string_view> text = take(name);
    if (!text) return std::nullopt;
    if (std::ranges::find(choices, *text) == choices.end()) {
        std::string expected;
        for (const std::string_view choice : choices) expected += (expected.empty() ? "" : ", ") + std::string(choice);
        refuse_parameter(name, *text, "one of " + expected);
    }
    return std::string(*text);
}

std::optional<std::string> QueryParameters::text(std::string_view name) {
    const std::optional<std::string_view> text = take(name);
    return text ? std::optional<std::string>(*text) : std::nullopt;
}

std::vector<std::string_view> QueryParameters::items(std::string_view name, std::size_t count) {
    std::vector<std::string_view> items;
    const std::optional<std::string_view> text = take(name);
    if (!text) return items;
    for (std::string_view rest = *text;;) {
        if (items.size() == count) refuse_parameter(name, *text, "at most " + std::to_string(count) + " numbers");
        const std::size_t comma = rest.find(',');
        items.push_back(rest.substr(0, comma));
        if (comma == std::string_view::npos) return items;
        rest.remove_prefix(comma + 1);
    }
}

std::vector<std::int64_t> QueryParameters::list(std::string_view name, std::int64_t min, std::int64_t max, std::size_t count) {
    std::vector<std::int64_t> numbers;
    for (const std::string_view item : items(name, count)) numbers.push_back(whole_in(name, item, min, max));
    return numbers;
}

void QueryParameters::reject_unknown() const {
    for (const auto& [name, text] : words_) {
        if (std::ranges::find(known_, name) != known_.end()) continue;
        std::string expected;
        for (const std::string_view word : known_) expected += (expected.empty() ? "" : ", ") + std::string(word);
        throw Error(
            ErrorKind::usage,
            {.where = name.substr(0, kLongestShown), .what = "unknown query parameter", .expected = expected.empty() ? "none" : expected});
    }
}

}  // namespace isoatlas
