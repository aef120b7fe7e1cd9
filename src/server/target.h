// Parses the target of a request: "/path?name=text&...".
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace isoatlas {

struct Target {
    std::string path;
    std::multimap<std::string, std::string> words;
};

/// "%41" is 'A' everywhere, '+' a space after the '?'; invalid codes stay as they are. O(length).
[[nodiscard]] Target target_of(std::string_view text);

/// "/volume/12/api/atlas": the number of the volume, and "/api/atlas". Other targets are those of no number.
struct VolumeTarget {
    std::optional<std::int64_t> volume;
    std::string_view prefix;  ///< "/volume/12", else ""
    std::string_view rest;
};
[[nodiscard]] VolumeTarget volume_target_of(std::string_view target);

}  // namespace isoatlas
