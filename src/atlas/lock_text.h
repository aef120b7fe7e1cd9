// Text of the lock file of a build: mark of the folder, process, and progress.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace isoatlas {

struct BuildState;

inline constexpr std::size_t kLockBytes = 512;  ///< sufficient to read

/// The first line: a folder without it was not made by a build.
inline constexpr std::string_view kBuildMark = "folder of an isoatlas build, removed when it is done\n";

/// The mark, the number of this process on a line, and the state on another one.
[[nodiscard]] std::string lock_text(const std::optional<BuildState>& state);

/// Is it the lock of a build? For a lock left empty or all zeros by a crash, has_mark() is false and is_blank() is true.
[[nodiscard]] bool has_mark(std::string_view text);
[[nodiscard]] bool is_blank(std::string_view text);
/// The line after the mark; "" without one.
[[nodiscard]] std::string holder_in(std::string_view text);
/// State of the next line; a missing or invalid one gives a build that has just begun.
[[nodiscard]] BuildState state_in(std::string_view text);

}  // namespace isoatlas
