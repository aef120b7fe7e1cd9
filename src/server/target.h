// The target of a request, taken apart: "/path?name=text&...".
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace isoatlas {

struct Target {
    std::string path;
    std::multimap<std::string, std::string> words;
};

/// "%41" is 'A' everywhere, '+' a space behind the '?'; what is no such code stays as it is. O(length).
[[nodiscard]] Target target_of(std::string_view text);

}  // namespace isoatlas
