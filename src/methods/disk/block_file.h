// Files of equal blocks, each with a checksum. The first block is the header: magic, size of a block, number of blocks, and numbers of the
// owner.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/atomic_file.h"
#include "base/file_system.h"

namespace isoatlas {

inline constexpr std::size_t kHeaderNumbers = 8;
using HeaderNumbers = std::array<std::int64_t, kHeaderNumbers>;
inline constexpr std::int64_t kBlockChecksum = 8;  ///< bytes at the end of a block

class BlockWriter {
public:
    /// magic: 16 letters.
    BlockWriter(const std::string& path, std::string_view magic, std::int64_t block_bytes);
    [[nodiscard]] std::int64_t payload_bytes() const { return block_bytes_ - kBlockChecksum; }
    /// So far, the header included: the number of the next one.
    [[nodiscard]] std::int64_t blocks() const { return blocks_; }
    /// At most payload_bytes(), the rest is zeros. Returns the number of the block.
    std::int64_t add(std::span<const std::byte> payload);
    void commit(const HeaderNumbers& numbers);

private:
    void put(std::int64_t number, std::span<const std::byte> payload);

    std::string magic_;
    std::int64_t block_bytes_, blocks_ = 1;
    AtomicFile file_;
};

/// Reads blocks and verifies them. Thread safe.
class BlockReader {
public:
    /// Throws Error{input}: missing, of another kind, truncated, damaged.
    BlockReader(std::string path, std::string_view magic);
    [[nodiscard]] const HeaderNumbers& numbers() const { return numbers_; }
    [[nodiscard]] std::int64_t block_bytes() const { return block_bytes_; }
    [[nodiscard]] std::int64_t payload_bytes() const { return block_bytes_ - kBlockChecksum; }
    [[nodiscard]] std::int64_t blocks() const { return blocks_; }
    /// The payload. Throws Error{input}: no such block, damaged.
    [[nodiscard]] std::vector<std::byte> read(std::int64_t number) const;
    /// The next blocks are read from the disk, where the system follows that hint.
    void drop_pages() const { file_->drop_pages(); }
    /// Throws Error{input}: contents contradict each other.
    [[noreturn]] void fail(const std::string& what) const;

private:
    std::string path_;
    std::unique_ptr<File> file_;
    std::int64_t block_bytes_ = 0, blocks_ = 0;
    HeaderNumbers numbers_{};
};

/// Numbers one after the other in a payload.
class PayloadWriter {
public:
    template <class T>
    void put(T value) {
        const auto bytes = std::as_bytes(std::span(&value, 1));
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }
    void clear() { bytes_.clear(); }

private:
    std::vector<std::byte> bytes_;
};

class PayloadReader {
public:
    PayloadReader(std::span<const std::byte> bytes, const BlockReader& of) : bytes_(bytes), of_(&of) {}
    template <class T>
    [[nodiscard]] T get() {
        if (bytes_.size() < sizeof(T)) of_->fail("a block is too short for its content");
        T value;
        std::copy_n(bytes_.begin(), sizeof(T), std::as_writable_bytes(std::span(&value, 1)).begin());
        bytes_ = bytes_.subspan(sizeof(T));
        return value;
    }

private:
    std::span<const std::byte> bytes_;
    const BlockReader* of_;
};

}  // namespace isoatlas
