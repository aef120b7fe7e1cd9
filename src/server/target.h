// Parses the target of a request: "/path?name=text&...".
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace isoatlas {

struct Target {
    std::string path;
    std::multimap<std::string, std::string> words;
};

/// "%41" is 'A' everywhere, '+' a space after the '?'; invalid codes stay as they are. O(length).
[[nodiscard]] Target target_of(std::string_view text);

}  // namespace isoatlas
