// The text header at the start of a file; its length is known when its end is found.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace isoatlas {

struct HeaderText {
    std::string text;         ///< everything before `end`, or the whole file
    std::int64_t end = 0;     ///< offset of the first byte after the header
    bool terminated = false;  ///< an end was found (else the file is all header)
};

/// Reads growing pieces of the file until find_end(text) gives the length of the header, at most 16 MiB.
/// Throws Error{input} when the file cannot be read or has no end of header within 16 MiB.
[[nodiscard]] HeaderText read_header_text(const std::string& path,
                                          const std::function<std::optional<std::size_t>(std::string_view)>& find_end);

/// The line of text that starts at `begin`, without its line end; advances `begin` past it.
[[nodiscard]] std::string_view take_line(std::string_view text, std::size_t& begin);

}  // namespace isoatlas
