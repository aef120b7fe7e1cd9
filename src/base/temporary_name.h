// Names of files that are being written: unpredictable, and not given by other programs by chance.
#pragma once

#include <string>
#include <string_view>

namespace isoatlas {

/// ".isoatlas-DIGITS.partial": 16 random hexadecimal digits, and 8 that follow from them.
[[nodiscard]] std::string temporary_name();
/// Is that the last part of a path?
[[nodiscard]] bool is_temporary_name(std::string_view path);

/// The folder that a path lies in, as it would be opened: "." for a name alone.
[[nodiscard]] std::string folder_of(const std::string& path);

}  // namespace isoatlas
