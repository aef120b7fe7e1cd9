// Bytes of remote files that are in memory: pieces that do not overlap, the ones used longest ago are dropped beyond a budget.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <mutex>
#include <span>
#include <vector>

#include "base/file_system.h"

namespace isoatlas {

/// Thread safe. Files are numbers that the caller gives them.
class PieceCache {
public:
    explicit PieceCache(std::int64_t budget) : budget_(budget) {}

    /// Copies the bytes from `offset` on that are there, without a gap; how many.
    [[nodiscard]] std::size_t read(std::int64_t file, std::int64_t offset, std::span<std::byte> out);
    /// The parts of a range that are not there, ascending.
    [[nodiscard]] std::vector<FileRange> missing(std::int64_t file, const FileRange& range) const;
    /// Bytes that are there already are not replaced. A piece larger than the budget stays until the next one comes.
    void add(std::int64_t file, std::int64_t begin, std::span<const std::byte> bytes);
    void forget(std::int64_t file);
    [[nodiscard]] std::int64_t bytes() const;

private:
    using Key = std::pair<std::int64_t, std::int64_t>;  ///< file, begin
    struct Piece {
        std::vector<std::byte> bytes;
        std::list<Key>::iterator used;
    };
    using Pieces = std::map<Key, Piece>;
    /// The piece with the byte at offset, or the first one behind it; end(): of another file, or none.
    [[nodiscard]] Pieces::const_iterator at_or_behind(std::int64_t file, std::int64_t offset) const;
    [[nodiscard]] std::vector<FileRange> missing_unlocked(std::int64_t file, const FileRange& range) const;
    void drop(Pieces::iterator piece);

    mutable std::mutex mutex_;
    Pieces pieces_;
    std::list<Key> order_;  ///< the one used last is the first
    std::int64_t bytes_ = 0, budget_;
};

}  // namespace isoatlas
