#include "remote/piece_cache.h"

#include <algorithm>
#include <cstring>

namespace isoatlas {
namespace {

constexpr std::int64_t kPieceBytes = 256 << 10;  ///< at most, so that a long fetch is not dropped as a whole

}  // namespace

PieceCache::Pieces::const_iterator PieceCache::at_or_behind(std::int64_t file, std::int64_t offset) const {
    auto next = pieces_.upper_bound({file, offset});
    if (next != pieces_.begin()) {
        const auto before = std::prev(next);
        const bool reaches =
            before->first.first == file && before->first.second + static_cast<std::int64_t>(before->second.bytes.size()) > offset;
        if (reaches) return before;
    }
    return next != pieces_.end() && next->first.first == file ? next : pieces_.end();
}

std::size_t PieceCache::read(std::int64_t file, std::int64_t offset, std::span<std::byte> out) {
    const std::scoped_lock lock(mutex_);
    std::size_t done = 0;
    while (done < out.size()) {
        const std::int64_t position = offset + static_cast<std::int64_t>(done);
        const auto piece = at_or_behind(file, position);
        if (piece == pieces_.end() || piece->first.second > position) break;
        const auto skipped = static_cast<std::size_t>(position - piece->first.second);
        const std::size_t count = std::min(piece->second.bytes.size() - skipped, out.size() - done);
        std::memcpy(out.data() + done, piece->second.bytes.data() + skipped, count);
        order_.splice(order_.begin(), order_, piece->second.used);
        done += count;
    }
    return done;
}

std::vector<FileRange> PieceCache::missing_unlocked(std::int64_t file, const FileRange& range) const {
    std::vector<FileRange> gaps;
    std::int64_t position = range.begin;
    while (position < range.end) {
        const auto piece = at_or_behind(file, position);
        const std::int64_t begin = piece == pieces_.end() ? range.end : std::min(piece->first.second, range.end);
        if (begin > position) gaps.push_back({position, begin});
        if (piece == pieces_.end()) break;
        position = piece->first.second + static_cast<std::int64_t>(piece->second.bytes.size());
    }
    return gaps;
}

std::vector<FileRange> PieceCache::missing(std::int64_t file, const FileRange& range) const {
    const std::scoped_lock lock(mutex_);
    return missing_unlocked(file, range);
}

void PieceCache::drop(Pieces::iterator piece) {
    bytes_ -= static_cast<std::int64_t>(piece->second.bytes.size());
    order_.erase(piece->second.used);
    pieces_.erase(piece);
}

void PieceCache::add(std::int64_t file, std::int64_t begin, std::span<const std::byte> bytes) {
    const std::scoped_lock lock(mutex_);
    for (const FileRange& gap : missing_unlocked(file, {begin, begin + static_cast<std::int64_t>(bytes.size())})) {
        for (std::int64_t from = gap.begin; from < gap.end; from += kPieceBytes) {
            const auto part =
                bytes.subspan(static_cast<std::size_t>(from - begin), static_cast<std::size_t>(std::min(kPieceBytes, gap.end - from)));
            order_.push_front({file, from});
            pieces_[{file, from}] = {{part.begin(), part.end()}, order_.begin()};
            bytes_ += static_cast<std::int64_t>(part.size());
        }
    }
    while (bytes_ > budget_ && pieces_.size() > 1) drop(pieces_.find(order_.back()));
}

void PieceCache::forget(std::int64_t file) {
    const std::scoped_lock lock(mutex_);
    for (auto piece = pieces_.lower_bound({file, 0}); piece != pieces_.end() && piece->first.first == file;) drop(piece++);
}

std::int64_t PieceCache::bytes() const {
    const std::scoped_lock lock(mutex_);
    return bytes_;
}

}  // namespace isoatlas
