// The Range field of a request (RFC 9110, section 14.2).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/file_system.h"

namespace isoatlas {

/// At most so many ranges in one request; more are an attempt to make the server work.
inline constexpr std::size_t kMostByteRanges = 512;

/// "bytes=0-99,200-,-50" of a file of `size` bytes, those that lie outside left out; nullopt: not such a field, which is ignored, or too
/// many ranges. Empty: none of them lies in the file.
[[nodiscard]] std::optional<std::vector<FileRange>> byte_ranges(std::string_view field, std::int64_t size);

}  // namespace isoatlas
