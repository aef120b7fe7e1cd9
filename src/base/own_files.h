// Files that only this user may read: what PrivateFile and KeptFolder have in common.
#pragma once

#include <string>
#include <string_view>

#include <sys/types.h>

namespace isoatlas {

inline constexpr mode_t kOwnFolder = 0700, kOwnFile = 0600, kOthers = 077;

/// The folder that an environment variable names, without a trailing slash of ours; empty: not set, or not an absolute path.
[[nodiscard]] std::string folder_in(const char* variable);

/// Whether all of the text was written, by one call.
[[nodiscard]] bool write_all(int file, std::string_view text);

}  // namespace isoatlas
