// Files that are not in memory: the system is asked to forget its pages of them.
#pragma once

#include <cstdint>
#include <string>

namespace bench {

/// Writes back what is not on the disk yet and drops the pages. Systems may refuse silently: bytes_from_disk() tells.
void drop_pages(const std::string& path);

/// Reads bytes of a file, again from its beginning when there are no more, into new memory, which is given back, with
/// so many calls, or a few more. bytes: more than 0.
void copy_to_new_memory(const std::string& path, std::int64_t bytes, std::int64_t reads);

/// Bytes that this process has caused to be read from disks so far (/proc/self/io); -1: unknown.
[[nodiscard]] std::int64_t bytes_from_disk();

}  // namespace bench
