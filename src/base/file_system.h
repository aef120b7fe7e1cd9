// FileSystem: the interface to files, for all that is written and all that is read by offsets. The default is the operating system's; tests
// substitute one that fails, loses what was not synced, or lives in memory.
//
// Nothing here throws: numbers below zero are -errno. Callers turn them into errors that name file and next step
// (formats/common/file_access.h for what is read, base/atomic_file.h for what is written).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "isoatlas/environment.h"

namespace isoatlas {

/// Bytes of a file.
struct FileRange {
    std::int64_t begin = 0, end = 0;
    [[nodiscard]] std::int64_t bytes() const { return end - begin; }
    bool operator==(const FileRange&) const = default;
};

/// An open file, closed by its destructor. Offsets are absolute; nothing is buffered. Operations that a kind of file does not support fail.
class File {
public:
    File() = default;
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    virtual ~File();
    /// Bytes when it was opened.
    [[nodiscard]] virtual std::int64_t size() const = 0;
    /// Reads at most out.size() bytes at offset; the number read (0 at the end of the file), or -errno. May be called by several threads.
    [[nodiscard]] virtual std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out);
    /// read_at() that does not block: -EAGAIN where none of the bytes is in memory.
    [[nodiscard]] virtual std::ptrdiff_t read_nowait(std::int64_t offset, std::span<std::byte> out);
    /// Hint that bytes, at least one, will be read soon (WILLNEED).
    virtual void prefetch(std::int64_t offset, std::int64_t bytes);
    /// The same for several ranges, ascending and not empty.
    virtual void prefetch_ranges(std::span<const FileRange> ranges);
    /// Files of other machines fetch such ranges now, in few requests, because single reads of them would follow; others do nothing.
    virtual void fetch_ranges(std::span<const FileRange> ranges);
    /// Hint that no page of the file, which was synced, needs to stay in memory (DONTNEED).
    virtual void drop_pages();
    /// Writes at most bytes.size() bytes at offset; the number written, or -errno. A hole before offset reads as zeros.
    [[nodiscard]] virtual std::ptrdiff_t write_at(std::int64_t offset, std::span<const std::byte> bytes);
    /// Cuts the file, or lengthens it by zeros. 0 or -errno, as all that follow.
    [[nodiscard]] virtual int resize(std::int64_t size);
    /// Reserves disk space for the bytes [0, size). Systems that cannot do so report success.
    [[nodiscard]] virtual int reserve(std::int64_t size);
    /// Returns when all that was written would survive a power failure.
    [[nodiscard]] virtual int sync();
    /// Permissions, exactly these.
    [[nodiscard]] virtual int set_mode(unsigned mode);
    /// Gives a file of create_unnamed() a name. -EEXIST: the name exists.
    [[nodiscard]] virtual int take_name(const std::string& path);
    /// Closes the file and reports errors of earlier writes. Called at most once, as the last function.
    [[nodiscard]] virtual int close();
};

struct FileStatus {
    enum class Kind { missing, regular, folder, link, other };
    Kind kind = Kind::missing;
    int error = 0;            ///< why it is missing: -errno
    unsigned mode = 0;        ///< permissions
    bool own = true;          ///< belongs to the user of this process
    bool trusted = true;      ///< belongs to that user, or to the superuser
    bool writable = true;     ///< this user may write to it; of an own file its permissions say so, even to the superuser
    std::uint64_t names = 1;  ///< of the file: more than one, when there are hard links
};

struct OpenedFile {
    std::unique_ptr<File> file;  ///< null: it cannot be opened
    int error = 0;               ///< -errno then
};

class FileSystem {
public:
    FileSystem() = default;
    FileSystem(const FileSystem&) = delete;
    FileSystem& operator=(const FileSystem&) = delete;
    virtual ~FileSystem();
    /// Status of a path; links are followed: Kind::link is never returned.
    [[nodiscard]] virtual FileStatus status(const std::string& path) = 0;
    /// Status of a path itself: a link where it ends in one.
    [[nodiscard]] virtual FileStatus status_of_name(const std::string& path);
    /// Opens a regular file to read it.
    [[nodiscard]] virtual OpenedFile open(const std::string& path) = 0;
    /// Target of a symbolic link; empty: the path is not a link.
    [[nodiscard]] virtual std::string link(const std::string& path);
    /// The absolute path without links, "." and ".."; what does not exist keeps its name. File systems other than the system's have no
    /// links.
    [[nodiscard]] virtual std::string resolved(const std::string& path);
    /// Opens a device or pipe to write to it: its write_at takes the next bytes, whatever the offset.
    [[nodiscard]] virtual OpenedFile open_stream(const std::string& path);
    /// Creates a new file with these permissions less the process's mask, locked until it is closed. -EEXIST: the name exists, even as a
    /// dangling link.
    [[nodiscard]] virtual OpenedFile create(const std::string& path, unsigned mode);
    /// The same in a folder without a name, so that it vanishes with its process: -EOPNOTSUPP where the disk has no such files.
    [[nodiscard]] virtual OpenedFile create_unnamed(const std::string& folder, unsigned mode);
    /// Opens a file, or creates an empty one, and locks it until it is closed; content stays. -EWOULDBLOCK: it is locked already; -EPERM:
    /// not a regular file of this user with one name.
    [[nodiscard]] virtual OpenedFile lock(const std::string& path);
    /// Is the file locked by lock()? Does not take the lock.
    [[nodiscard]] virtual bool is_held(const std::string& path);
    /// Removes a regular file of this user with one name that is not locked; it stays where locks cannot be tested.
    virtual void remove_abandoned(const std::string& path);
    [[nodiscard]] virtual int rename(const std::string& from, const std::string& to);
    [[nodiscard]] virtual int remove(const std::string& path);
    /// -EEXIST: the name exists.
    [[nodiscard]] virtual int make_folder(const std::string& path);
    /// An empty one.
    [[nodiscard]] virtual int remove_folder(const std::string& path);
    /// Names of at most `max` entries of a folder, unordered; empty when it cannot be read.
    [[nodiscard]] virtual std::vector<std::string> entries(const std::string& path, std::size_t max);
    /// Returns when the names in a folder would survive a power failure. Systems that cannot guarantee it report success.
    [[nodiscard]] virtual int sync_folder(const std::string& path);
};

/// The file system of the current environment: the operating system's, unless a test has replaced it.
[[nodiscard]] FileSystem& file_system();
/// That of the operating system.
[[nodiscard]] FileSystem& system_files();
/// What environments without files of their own have from now on, for the whole process; nullptr: the operating system's. It must live as
/// long as it is in use.
void set_default_files(FileSystem* files);
/// A file of another machine: http:// or https://.
[[nodiscard]] inline bool is_address(std::string_view path) { return path.starts_with("http://") || path.starts_with("https://"); }

/// For tests: while it lives, the current environment has these files.
class ReplacedFileSystem {
public:
    explicit ReplacedFileSystem(FileSystem& files);

private:
    EnvironmentScope scope_;
};

/// Writes all bytes, repeating short and interrupted writes. 0 or -errno.
[[nodiscard]] int write_fully(File& file, std::int64_t offset, std::span<const std::byte> bytes);

}  // namespace isoatlas
