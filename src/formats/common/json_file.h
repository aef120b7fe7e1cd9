// A small JSON file, checked before a parser that recurses sees it.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace isoatlas {

struct JsonFileLimits {
    std::int64_t bytes = std::int64_t{16} << 20;
    int depth = 4;
};

/// The object that the file holds. Throws Error{input}, completed with `what` and `next`: not readable, longer or nested deeper than the
/// limits, no JSON object, or `schema` is not its member of this name. Cost: the file is read whole.
[[nodiscard]] nlohmann::ordered_json read_json_file(const std::string& path, const std::string& schema, const std::string& what,
                                                    const std::string& next, const JsonFileLimits& limits = {});

}  // namespace isoatlas
