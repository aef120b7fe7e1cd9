// AtomicFile: how every file of the project is written. Either the whole file appears under its name, or nothing changes.
//
//   AtomicFile file("table.csv");
//   file.write("a,b\n");
//   file.commit();
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isoatlas {

/// Writes `<path>.partial`; commit() syncs it and renames it to `path`; without commit() the destructor removes it.
/// A symbolic link is followed (its target is replaced, the link stays); devices and pipes (/dev/stdout) are written directly.
/// Every function throws Error{resource} with path, reason of the system and next step. Writes are buffered. Not thread safe.
class AtomicFile {
public:
    explicit AtomicFile(std::string path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);
    /// Replaces bytes already written, e.g. a length in a header. offset + bytes.size() <= size(). Not possible on devices and pipes.
    void overwrite(std::int64_t offset, std::span<const std::byte> bytes);
    /// Number of bytes written so far: the offset of the next one.
    [[nodiscard]] std::int64_t size() const { return size_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    /// Nothing may be written afterwards.
    void commit();

private:
    [[noreturn]] void fail(const char* action, int error_number) const;
    void open_partial();
    void flush();
    void put(const std::byte* data, std::size_t count, std::int64_t offset);
    void discard() noexcept;

    std::string path_;     ///< as the caller gave it, for messages
    std::string target_;   ///< where it goes: path_ with links resolved
    std::string partial_;  ///< empty when the target is written directly
    int descriptor_ = -1;
    std::int64_t size_ = 0;
    std::vector<std::byte> buffer_;  ///< the last bytes of size_
};

/// Bytes of trivially copyable values, to write them.
template <class T>
[[nodiscard]] std::span<const std::byte> bytes_of(std::span<const T> values) {
    return std::as_bytes(values);
}
template <class T>
[[nodiscard]] std::span<const std::byte> bytes_of(const std::vector<T>& values) {
    return std::as_bytes(std::span<const T>(values));
}

/// For tests: while it lives, every AtomicFile fails with `error_number` (ENOSPC, EIO, ...) at the byte `after` of its file.
class WriteFault {
public:
    WriteFault(std::int64_t after, int error_number);
    ~WriteFault();
    WriteFault(const WriteFault&) = delete;
    WriteFault& operator=(const WriteFault&) = delete;
};

}  // namespace isoatlas
