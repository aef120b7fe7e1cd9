#include "formats/common/file_extension.h"

#include <algorithm>
#include <filesystem>

#include "formats/common/text.h"
#include "isoatlas/error.h"

namespace isoatlas {

std::string lower_extension(const std::string& path) { return lower(std::filesystem::path(path).extension().string()); }

void refuse_extension(const std::string& path, const FormatWords& words) {
    const std::string extension = lower_extension(path);
    throw Error(ErrorKind::usage,
                {.file = path,
                 .what = extension.empty() ? std::string("the name has no extension, so ") + words.the_format + " is unknown"
                                           : std::string("unknown ") + words.format + " \"" + extension + "\"",
                 .expected = words.known,
                 .next = "give the file one of these extensions"});
}

std::string known_extension(const std::string& path, std::initializer_list<const char*> known, const FormatWords& words) {
    std::string extension = lower_extension(path);
    if (std::find(known.begin(), known.end(), extension) == known.end()) refuse_extension(path, words);
    return extension;
}

}  // namespace isoatlas
