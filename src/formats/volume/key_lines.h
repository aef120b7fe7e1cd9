// Text headers of lines "KEY: value": BOV and .dat files.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "isoatlas/error.h"

namespace isoatlas {

class KeyLines {
public:
    /// Lines of a file of at most 1 MiB; those that begin with # or // are comments. known: the keys, in lower case. Throws Error{input}
    /// when a line is no such pair, and when a key is that close to a known one that it is damaged.
    KeyLines(const std::string& path, std::span<const std::string_view> known);

    [[nodiscard]] const std::string& path() const { return path_; }
    /// Of lines of a key (in any case), in their order.
    [[nodiscard]] std::vector<std::string> all(std::string_view key) const;
    [[nodiscard]] bool has(std::string_view key) const { return !all(key).empty(); }
    /// Of the one line of a key; empty when there is none. Throws Error{input} when there are several.
    [[nodiscard]] std::string text(std::string_view key) const;
    /// Finite numbers of the one line of a key; nullopt: there is none. Throws Error{input} for another count, and for what is no number.
    [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count) const;
    [[nodiscard]] std::optional<std::vector<std::int64_t>> integers(std::string_view key, std::size_t count) const;
    /// Not negative; 0 when there is none.
    [[nodiscard]] std::int64_t offset(std::string_view key) const;

    [[noreturn]] void fail(ErrorKind kind, std::string_view key, const std::string& what, const std::string& expected,
                           const std::string& next = "correct the header or get the file again") const;

private:
    std::string path_;
    std::vector<std::pair<std::string, std::string>> lines_;  ///< keys as the file spells them
};

/// Whether a text has a line that begins with one of the keys (in lower case) and a colon.
[[nodiscard]] bool has_key_line(std::string_view text, std::span<const std::string_view> keys);

}  // namespace isoatlas
