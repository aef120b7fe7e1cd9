// AtomicFile: the Sink of a file on disk, used for every file of the project. Either the whole file appears under its name, or nothing
// changes.
//
//   AtomicFile file("table.csv");
//   file.write("a,b\n");
//   file.commit();
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_system.h"
#include "isoatlas/sink.h"

namespace isoatlas {

/// Writes a file without a name in the folder of `path`, or, where the disk has none, one with an unpredictable name; commit() syncs it and
/// gives it the name `path`. Without commit(), or when the process ends, it is gone; names that a crash has left are removed by the next
/// file in that folder. What may be replaced and what is refused: isoatlas/output_file.h. Of two writers of one path the last commit()
/// wins. Every function throws Error{resource} with path, reason of the system and next step. Writes are buffered. Not thread safe.
class AtomicFile final : public Sink {
public:
    explicit AtomicFile(std::string path);
    ~AtomicFile() override;

    using Sink::write;
    void write(std::span<const std::byte> bytes) override;
    /// Not possible on devices and pipes.
    void write_at(std::int64_t offset, std::span<const std::byte> bytes) override;
    /// Reserves disk space for a file of that size, where the system can, so that a full disk is reported before the work.
    void reserve(std::int64_t size);
    /// Lengthens the file by zeros. size >= size().
    void extend(std::int64_t size);
    [[nodiscard]] std::int64_t size() const override { return size_; }
    /// Nothing may be written afterwards.
    void commit();

private:
    [[noreturn]] void fail(const char* action, int error) const;
    void require(int error, const char* action) const;
    void open();
    void open_temporary(unsigned mode);
    void take_name();
    void flush();
    void put(std::int64_t offset, std::span<const std::byte> bytes);
    void discard() noexcept;

    std::string target_;      ///< where it goes: name() with links followed
    std::string partial_;     ///< its name until then; empty: none
    bool is_stream_ = false;  ///< written directly
    std::unique_ptr<File> file_;
    std::int64_t size_ = 0;
    std::int64_t written_ = 0;  ///< of a device or pipe: bytes it has taken
    std::int64_t buffer_begin_ = 0;
    std::vector<std::byte> buffer_;  ///< bytes from buffer_begin_ on that are still to be written
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

}  // namespace isoatlas
