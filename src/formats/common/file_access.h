// File access with errors that name a next step. All formats open, size and read files through these functions, and these use
// base/file_system.h (libtiff as well), so that tests can inject a failing disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_system.h"

namespace isoatlas {

/// Opens a regular file. Throws Error{input}: missing, a directory, not a regular file, no permission.
[[nodiscard]] std::unique_ptr<File> open_file(const std::string& path);
/// Bytes in memory as a file to read. They must outlive it.
[[nodiscard]] std::unique_ptr<File> open_bytes(std::string_view bytes);
/// Whether there is a regular file of that name. Never throws.
[[nodiscard]] bool file_exists(const std::string& path);
/// Whether there is a directory of that name. Never throws.
[[nodiscard]] bool is_directory(const std::string& path);
/// Names of at most `max` entries of a directory, unordered; empty when it cannot be read. Never throws.
[[nodiscard]] std::vector<std::string> directory_entries(const std::string& path, std::size_t max);

/// Fills all of out from offset, repeating short reads. Throws Error{input} when the file ends before or the disk fails.
void read_fully(File& file, const std::string& path, std::int64_t offset, std::span<std::byte> out);
/// Like read_fully, but stops at the end of the file; the number of bytes read.
[[nodiscard]] std::size_t read_available(File& file, const std::string& path, std::int64_t offset, std::span<std::byte> out);
/// Fills all of out without blocking on a disk; false: it would block, out is undefined. Throws Error{input} when the disk fails.
[[nodiscard]] bool read_if_present(File& file, const std::string& path, std::int64_t offset, std::span<std::byte> out);

}  // namespace isoatlas
