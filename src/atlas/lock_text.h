// What the lock of a build says: who holds it, and where the build is.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "isoatlas/build.h"

namespace isoatlas {

inline constexpr std::size_t kLockBytes = 512;  ///< that are enough to read

/// The number of this process on a line, and the state on another one.
[[nodiscard]] std::string lock_text(const std::optional<BuildState>& state);

/// The first line.
[[nodiscard]] std::string holder_in(std::string_view text);
/// Of the second line; one that is not there, or is not what lock_text() writes, gives a build that has only begun.
[[nodiscard]] BuildState state_in(std::string_view text);

}  // namespace isoatlas
