// The query parameters of a request, parsed strictly: unknown, repeated and out-of-range parameters are rejected, with the valid range.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isoatlas {

class QueryParameters {
public:
    explicit QueryParameters(const std::multimap<std::string, std::string>& words) : words_(words) {}

    /// All throw Error{usage}: not a number, not finite, out of range, more than one.
    [[nodiscard]] std::optional<double> number(std::string_view name);
    [[nodiscard]] std::optional<double> number(std::string_view name, double min);
    [[nodiscard]] double required_tau();  ///< also where it is missing
    [[nodiscard]] std::optional<std::int64_t> whole(std::string_view name, std::int64_t min, std::int64_t max);
    [[nodiscard]] std::optional<std::string> choice(std::string_view name, const std::vector<std::string_view>& choices);
    /// Numbers between commas, at most `count`.
    [[nodiscard]] std::vector<std::int64_t> list(std::string_view name, std::int64_t min, std::int64_t max, std::size_t count);
    /// Any text.
    [[nodiscard]] std::optional<std::string> text(std::string_view name);
    /// The items between the commas of a parameter, at most `count`; empty when it is missing.
    [[nodiscard]] std::vector<std::string_view> items(std::string_view name, std::size_t count);
    /// Throws Error{usage} for a parameter that was not read.
    void reject_unknown() const;

private:
    [[nodiscard]] std::optional<std::string_view> take(std::string_view name);

    const std::multimap<std::string, std::string>& words_;
    std::vector<std::string_view> known_;
};

}  // namespace isoatlas
