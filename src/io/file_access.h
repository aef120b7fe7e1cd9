// The one door to the files that are read: everything in io opens, sizes and reads files through here, so a test can put a
// failing disk behind it. Nothing else in src/io calls the operating system (libtiff reads through it as well).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace isoatlas::io {

/// An open file. Offsets are absolute; nothing is buffered.
class FileHandle {
public:
    virtual ~FileHandle() = default;
    [[nodiscard]] virtual std::int64_t size() const = 0;
    /// Reads at most out.size() bytes at offset; the number read (0 at the end of the file), or -errno.
    [[nodiscard]] virtual std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) = 0;
};

using FileOpener = std::function<std::unique_ptr<FileHandle>(const std::string& path)>;

/// Opens a regular file. Throws Error{input}: missing, a directory, not a regular file, no permission.
[[nodiscard]] std::unique_ptr<FileHandle> open_file(const std::string& path);
/// The opener that talks to the operating system.
[[nodiscard]] std::unique_ptr<FileHandle> open_system_file(const std::string& path);
/// Whether there is a regular file of that name. Never throws.
[[nodiscard]] bool file_exists(const std::string& path);
/// Whether there is a directory of that name. Never throws.
[[nodiscard]] bool is_directory(const std::string& path);
/// Names of at most `most` entries of a directory, in no order; nothing when it cannot be read. Never throws.
[[nodiscard]] std::vector<std::string> directory_entries(const std::string& path, std::size_t most);
/// For tests: from now on open_file uses `opener` (empty: the operating system again). Not thread safe.
void replace_file_opener(FileOpener opener);

/// Fills all of out from offset, repeating short reads. Throws Error{input} when the file ends before or the disk fails.
void read_fully(FileHandle& file, const std::string& path, std::int64_t offset, std::span<std::byte> out);
/// Like read_fully, but stops at the end of the file; the number of bytes read.
[[nodiscard]] std::size_t read_available(FileHandle& file, const std::string& path, std::int64_t offset, std::span<std::byte> out);

}  // namespace isoatlas::io
