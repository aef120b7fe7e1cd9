// The format of a file follows its name.
#pragma once

#include <initializer_list>
#include <string>

namespace isoatlas {

/// What a message says of the formats: "the format of the tree", "format of a tree", ".csv or .json".
struct FormatWords {
    const char* the_format;
    const char* format;
    const char* known;
};

/// The extension of a name in small letters, with its dot.
[[nodiscard]] std::string lower_extension(const std::string& path);
/// Throws Error{usage}: the extension is none of the known ones.
[[noreturn]] void refuse_extension(const std::string& path, const FormatWords& words);
/// The extension in small letters. Throws Error{usage} when it is not among `known`.
[[nodiscard]] std::string known_extension(const std::string& path, std::initializer_list<const char*> known, const FormatWords& words);

}  // namespace isoatlas
