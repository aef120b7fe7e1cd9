// Foreign bytes as text: headers, units and file names need not be UTF-8, and what isoatlas shows or writes always is. Similar words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace isoatlas {

/// Whether the bytes are well-formed UTF-8 (no overlong forms, no surrogates, nothing beyond U+10FFFF).
[[nodiscard]] bool is_utf8(std::string_view bytes);
/// Text of a header: UTF-8 stays what it is; anything else is understood as Windows-1252, which contains Latin-1.
[[nodiscard]] std::string decoded_text(std::string_view bytes);
/// decoded_text() without control characters, which are written as \x1b; of these, line ends and tabs stay where `lines` says so.
[[nodiscard]] std::string header_text(std::string_view bytes, bool lines = false);
/// A name as it can be written anywhere: bytes that are not UTF-8 become \xe4. For JSON, which escapes control characters itself.
[[nodiscard]] std::string written_name(std::string_view name);
/// written_name() with control characters as \x1b, too: fit for a terminal.
[[nodiscard]] std::string shown_name(std::string_view name);
/// The longest beginning of UTF-8 text that has at most so many bytes and cuts no character.
[[nodiscard]] std::string_view utf8_prefix(std::string_view text, std::size_t max);

/// Bytes to insert, remove or replace to turn one word into the other (Wagner & Fischer 1974). Cost: the product of their lengths.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace isoatlas
