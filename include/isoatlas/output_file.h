// The files that isoatlas writes: which ones may be replaced, and what becomes of those that are not finished.
//
// A file is written in its folder without a name, or under an unpredictable one, synced, and given its name: under that name is the old
// file or the new one, whole. These functions refuse what the writers refuse to replace, before long work begins.
#pragma once

#include <string>
#include <string_view>

namespace isoatlas {

/// The file that a writer of `path` makes or replaces: `path`, or the regular file of this user that links of this user (or of the
/// superuser) lead to. Throws Error{resource} for what no writer replaces: folders; devices, pipes and sockets; files without permission to
/// write; links that another user made, that lead nowhere, or to another user's file; and where the folder is missing or may not be
/// written to. /dev/stdout and /dev/fd/N are what the process has open, and are written to as they are. Cost: a few system calls.
[[nodiscard]] std::string output_target(const std::string& path);

/// Throws what output_target() throws.
void check_output_file(const std::string& path);

/// Writes the bytes as the whole file: under its name is the old file or this one. Throws Error{resource}.
void write_output(const std::string& path, std::string_view bytes);

/// Removes what this process is writing, where the disk gives it a name before it is finished: for signal handlers, before they end the
/// process (async-signal-safe). What has no name is gone with the process.
void remove_unfinished_files() noexcept;

}  // namespace isoatlas
