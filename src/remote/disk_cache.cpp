#include "remote/disk_cache.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kKeptBytes = std::int64_t{1} << 20;  ///< at most
constexpr std::size_t kSumBytes = 8;
constexpr double kKept = 0.8;  ///< of the budget, after pieces were removed
constexpr std::size_t kMostPieces = 100000;

std::string hex(std::uint64_t number) {
    std::string text(16, '0');
    std::array<char, 16> digits{};
    const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), number, 16).ptr;
    std::copy(static_cast<const char*>(digits.data()), end, text.end() - (end - digits.data()));
    return text;
}

std::optional<FileRange> range_of(const std::string& name) {
    FileRange range;
    const char* const last = name.data() + name.size();
    const auto [dash, first_error] = std::from_chars(name.data(), last, range.begin);
    if (first_error != std::errc() || dash == last || *dash != '-') return std::nullopt;
    const auto [end, second_error] = std::from_chars(dash + 1, last, range.end);
    if (second_error != std::errc() || end != last || range.begin < 0 || range.bytes() < 1 || range.bytes() > kKeptBytes)
        return std::nullopt;
    return range;
}

std::string name_of(const FileRange& range) { return std::to_string(range.begin) + "-" + std::to_string(range.end); }

/// The bytes of a piece without its checksum; nullopt: it is not there, or damaged.
std::optional<std::vector<std::byte>> read_piece(const std::string& path, std::int64_t bytes) {
    const OpenedFile opened = system_files().open(path);
    if (!opened.file || opened.file->size() != bytes + static_cast<std::int64_t>(kSumBytes)) return std::nullopt;
    std::vector<std::byte> all(static_cast<std::size_t>(opened.file->size()));
    for (std::size_t done = 0; done < all.size();) {
        const std::ptrdiff_t got = opened.file->read_at(static_cast<std::int64_t>(done), std::span(all).subspan(done));
        if (got <= 0) return std::nullopt;
        done += static_cast<std::size_t>(got);
    }
    std::uint64_t sum = 0;
    std::memcpy(&sum, all.data(), kSumBytes);
    if (XXH3_64bits(all.data() + kSumBytes, all.size() - kSumBytes) != sum) return std::nullopt;
    all.erase(all.begin(), all.begin() + kSumBytes);
    return all;
}

bool write_piece(const std::string& path, std::span<const std::byte> bytes) {
    const std::uint64_t sum = XXH3_64bits(bytes.data(), bytes.size());
    const std::string temporary = path + ".part";
    const OpenedFile opened = system_files().create(temporary, 0600);
    if (!opened.file) return false;  // another process writes it, or there is no room
    const bool is_written = write_fully(*opened.file, 0, std::as_bytes(std::span(&sum, 1))) == 0 &&
                            write_fully(*opened.file, kSumBytes, bytes) == 0 && system_files().rename(temporary, path) == 0;
    if (!is_written) (void)system_files().remove(temporary);
    return is_written;
}

struct Kept {
    fs::file_time_type used;
    fs::path path;
    std::int64_t bytes;
};

std::vector<Kept> pieces_in(const std::string& folder) {
    std::vector<Kept> pieces;
    std::error_code failed;
    for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end && pieces.size() < kMostPieces;
         at.increment(failed)) {
        std::error_code ignored;
        if (!at->is_regular_file(ignored)) continue;
        const auto bytes = static_cast<std::int64_t>(at->file_size(ignored));
        if (!ignored) pieces.push_back({at->last_write_time(ignored), at->path(), bytes});
    }
    return pieces;
}

}  // namespace

DiskCache::DiskCache(std::string folder, std::int64_t budget) : folder_(budget > 0 ? std::move(folder) : ""), budget_(budget) {}

CachedVersion DiskCache::open(const std::string& identity) const {
    if (folder_.empty()) return {};
    const XXH128_hash_t name = XXH3_128bits(identity.data(), identity.size());
    CachedVersion version{.folder = folder_ + "/" + hex(name.high64) + hex(name.low64), .ends = {}};
    for (const std::string& entry : system_files().entries(version.folder, kMostPieces)) {
        if (const std::optional<FileRange> range = range_of(entry)) {
            std::int64_t& end = version.ends[range->begin];
            end = std::max(end, range->end);
        }
    }
    return version;
}

std::int64_t DiskCache::load(CachedVersion& version, const FileRange& range,
                             const std::function<void(std::int64_t, std::span<const std::byte>)>& take) const {
    std::int64_t loaded = 0;
    auto piece = version.ends.upper_bound(range.begin - kKeptBytes);
    while (piece != version.ends.end() && piece->first < range.end) {
        const FileRange there{piece->first, piece->second};
        if (there.end <= range.begin) {
            ++piece;
            continue;
        }
        const std::string path = version.folder + "/" + name_of(there);
        const std::optional<std::vector<std::byte>> bytes = read_piece(path, there.bytes());
        if (!bytes) {
            (void)system_files().remove(path);
            piece = version.ends.erase(piece);
            continue;
        }
        std::error_code ignored;
        fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
        take(there.begin, *bytes);
        loaded += there.bytes();
        ++piece;
    }
    return loaded;
}

void DiskCache::store(CachedVersion& version, std::int64_t begin, std::span<const std::byte> bytes) {
    if (version.folder.empty()) return;
    std::error_code ignored;
    if (fs::create_directories(version.folder, ignored)) fs::permissions(folder_, fs::perms::owner_all, ignored);
    for (std::size_t done = 0; done < bytes.size(); done += static_cast<std::size_t>(kKeptBytes)) {
        const auto part = bytes.subspan(done, std::min(static_cast<std::size_t>(kKeptBytes), bytes.size() - done));
        const FileRange range{begin + static_cast<std::int64_t>(done), begin + static_cast<std::int64_t>(done + part.size())};
        if (!write_piece(version.folder + "/" + name_of(range), part)) return;
        std::int64_t& end = version.ends[range.begin];
        end = std::max(end, range.end);
        count(range.bytes());
    }
}

void DiskCache::count(std::int64_t bytes) {
    const std::scoped_lock lock(mutex_);
    if (bytes_ < 0) {
        bytes_ = 0;
        for (const Kept& piece : pieces_in(folder_)) bytes_ += piece.bytes;
    } else {
        bytes_ += bytes;
    }
    if (bytes_ <= budget_) return;
    prune();
    bytes_ = -1;
}

void DiskCache::prune() const {
    std::vector<Kept> pieces = pieces_in(folder_);
    std::ranges::sort(pieces, {}, [](const Kept& piece) { return std::pair(piece.used, piece.path); });
    std::int64_t total = 0;
    for (const Kept& piece : pieces) total += piece.bytes;
    for (const Kept& piece : pieces) {
        if (static_cast<double>(total) <= kKept * static_cast<double>(budget_)) break;
        (void)system_files().remove(piece.path.string());
        total -= piece.bytes;
        std::error_code ignored;
        fs::remove(piece.path.parent_path(), ignored);  // where it was the last one
    }
}

}  // namespace isoatlas
