// Pages of memory, in which the system maps it.
#pragma once

#include <cstddef>

namespace isoatlas {

inline constexpr std::size_t kPage = 4096;
inline constexpr std::size_t kHugePage = std::size_t{1} << 21;

/// The next multiple of `unit`.
[[nodiscard]] constexpr std::size_t rounded_up(std::size_t bytes, std::size_t unit) { return (bytes + unit - 1) / unit * unit; }

}  // namespace isoatlas
