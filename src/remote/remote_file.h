// A file of another machine, read by ranges.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <mutex>
#include <string>

#include "base/file_system.h"
#include "remote/disk_cache.h"
#include "remote/http_client.h"
#include "remote/piece_cache.h"

namespace isoatlas {

/// Files opened a moment ago: programs look at what a file is, then open it to read it. Thread safe.
class RecentFiles {
public:
    static constexpr std::chrono::seconds kRecent{5};  ///< after that the server is asked again whether there is a new version
    [[nodiscard]] std::shared_ptr<File> find(const std::string& address);  ///< nullptr: none
    void add(const std::string& address, std::shared_ptr<File> file);
    void forget();

private:
    static constexpr std::size_t kMostRecent = 16;
    struct Recent {
        std::string address;
        std::shared_ptr<File> file;
        std::chrono::steady_clock::time_point opened;
    };
    std::mutex mutex_;
    std::deque<Recent> files_;
};

/// What files share. It lives as long as the last of them.
struct RemoteShared {
    explicit RemoteShared(const RemoteOptions& options);
    RemoteOptions options;
    HttpClient client;
    PieceCache pieces;
    DiskCache disk;
    std::atomic<std::int64_t> files = 0, from_disk = 0;
    RecentFiles recent;
};

/// Opens an address. `given`: for messages. The file throws Error{input} itself, where files of this machine return numbers below zero;
/// only File::read_nowait() never does. Throws Error: input (see remote.h), usage (not an address).
/// Null: there is no such file on the server (404, 410).
[[nodiscard]] std::unique_ptr<File> open_remote_file(const std::shared_ptr<RemoteShared>& shared, const std::string& given);

/// Is there an answer of success at the address? false also where the server does not answer.
[[nodiscard]] bool exists_remotely(RemoteShared& shared, const std::string& given);

}  // namespace isoatlas
