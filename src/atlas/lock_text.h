// What the lock of a build says: that the folder was made by a build, who holds it, and where the build is.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "isoatlas/build.h"

namespace isoatlas {

inline constexpr std::size_t kLockBytes = 512;  ///< that are enough to read

/// The first line: a folder without it was made by somebody else.
inline constexpr std::string_view kBuildMark = "folder of an isoatlas build, removed when it is done\n";

/// The mark, the number of this process on a line, and the state on another one.
[[nodiscard]] std::string lock_text(const std::optional<BuildState>& state);

/// Is it the lock of a build? One that a crash has left empty, or all zeros, has_mark() does not take for one, is_blank() does.
[[nodiscard]] bool has_mark(std::string_view text);
[[nodiscard]] bool is_blank(std::string_view text);
/// The line behind the mark; "" without one.
[[nodiscard]] std::string holder_in(std::string_view text);
/// Of the line behind that; one that is not there, or is not what lock_text() writes, gives a build that has only begun.
[[nodiscard]] BuildState state_in(std::string_view text);

}  // namespace isoatlas
