// Content codings of HTTP.
#pragma once

#include <string>
#include <string_view>

namespace isoatlas {

/// The best coding that an Accept-Encoding header allows: "zstd", "gzip" or "" (none).
[[nodiscard]] std::string_view coding_for(std::string_view accept);

/// The bytes in that coding.
[[nodiscard]] std::string coded(std::string_view bytes, std::string_view coding);

}  // namespace isoatlas
