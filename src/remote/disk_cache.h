// Pieces of remote files on disk, for the next process. One folder for each version of a file, one file for each piece, with a checksum.
// Several processes may share it: pieces appear whole, and one that vanishes or is damaged is fetched again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <span>
#include <string>

#include "base/file_system.h"

namespace isoatlas {

/// Which pieces of a version of a file were there when it was opened, and came since.
struct CachedVersion {
    std::string folder;                         ///< "": nothing is kept
    std::map<std::int64_t, std::int64_t> ends;  ///< of pieces, by their begin
};

/// Thread safe but for the versions, each of which one thread at a time uses.
class DiskCache {
public:
    /// folder "" or budget 0: nothing is kept.
    DiskCache(std::string folder, std::int64_t budget);

    /// identity: the address, and what tells its versions apart.
    [[nodiscard]] CachedVersion open(const std::string& identity) const;
    /// Calls take(begin, bytes) for every undamaged piece that meets the range. Returns the bytes taken.
    std::int64_t load(CachedVersion& version, const FileRange& range,
                      const std::function<void(std::int64_t, std::span<const std::byte>)>& take) const;
    /// Keeps bytes; failures (a full disk) are ignored. Removes the pieces used longest ago when the budget is exceeded.
    void store(CachedVersion& version, std::int64_t begin, std::span<const std::byte> bytes);

private:
    void count(std::int64_t bytes);
    void prune() const;

    std::string folder_;
    std::int64_t budget_;
    std::mutex mutex_;
    std::int64_t bytes_ = -1;  ///< in the folder, as far as known; -1: not counted yet
};

}  // namespace isoatlas
