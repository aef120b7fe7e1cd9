// Files of other machines: http:// and https:// addresses wherever a path of a file to read is taken. Only the bytes that are asked for are
// fetched, by range requests.
//
// Any static server is good that answers ranges (nginx, Apache, S3, GitHub pages; `isoatlas serve FOLDER`). A file of one that does not is
// read if it is small. A file that changes on its server while it is open is an error, never a mix of both.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace isoatlas {

struct RemoteOptions {
    std::int64_t memory = std::int64_t{64} << 20;     ///< bytes kept in memory, of all files together
    std::int64_t disk_cache = std::int64_t{1} << 30;  ///< bytes kept on disk for the next process; 0: none
    std::string cache_folder;                         ///< "": isoatlas/remote in $XDG_CACHE_HOME, or ~/.cache
    std::string token;                                ///< "Authorization: Bearer TOKEN", to https and this machine only
    std::string certificates;                         ///< file of trusted authorities; "": $SSL_CERT_FILE, or the system's
    int connections = 6;                              ///< at a time, per file
    int attempts = 5;                                 ///< of a request that fails in a way that may pass, with growing pauses
    double timeout = 15;                              ///< seconds without a byte
    std::function<bool()> cancelled{};                ///< asked several times a second while waiting; true: Error{cancelled}
};

/// What was fetched since use_remote_files().
struct RemoteTraffic {
    std::int64_t requests = 0;     ///< sent, repeated ones too
    std::int64_t round_trips = 0;  ///< at most so many of them waited for one another: those that are sent together count once
    std::int64_t bytes = 0;        ///< of bodies that came
    std::int64_t repeated = 0;     ///< requests sent again
    std::int64_t from_disk = 0;    ///< bytes of the disk cache
};

/// From now on the process reads addresses, too. Called again: with other options, for files opened later.
/// Errors of addresses are Error{input} when something is opened or read: no answer, not found, not allowed, no ranges, redirected to
/// another host, a certificate that is not trusted, changed on the server; each with what to do. Thread safe.
void use_remote_files(const RemoteOptions& options = {});
[[nodiscard]] RemoteTraffic remote_traffic();
/// The folder of the disk cache of these options; "" where there is none.
[[nodiscard]] std::string remote_cache_folder(const RemoteOptions& options = {});

}  // namespace isoatlas
