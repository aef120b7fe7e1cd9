// Chooses the format of a file by its extension.
#pragma once

#include <initializer_list>
#include <string>

namespace isoatlas {

/// Parts of a message about formats: "the format of the tree", "format of a tree", ".csv or .json".
struct FormatWords {
    const char* the_format;
    const char* format;
    const char* known;
};

/// The extension of a name in lower case, with its dot.
[[nodiscard]] std::string lower_extension(const std::string& path);
/// Throws Error{usage}: unknown extension.
[[noreturn]] void refuse_extension(const std::string& path, const FormatWords& words);
/// The extension in lower case. Throws Error{usage} when it is not among `known`.
[[nodiscard]] std::string known_extension(const std::string& path, std::initializer_list<const char*> known, const FormatWords& words);

}  // namespace isoatlas
