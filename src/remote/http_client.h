// Requests for ranges of bytes, several at a time, repeated where that may help.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "base/file_system.h"
#include "isoatlas/remote.h"
#include "remote/address.h"

namespace isoatlas {

/// Ranges asked for in one request, ascending and apart. Servers may not support several.
using RangeSet = std::vector<FileRange>;

/// Bytes of the file that came, where they lie in the body.
struct AnswerPart {
    FileRange range;
    std::size_t place = 0;
};

struct HttpAnswer {
    int status = 0;                 ///< 0: none came
    std::vector<std::byte> body;    ///< of a whole file (200): all of it when it has at most max_whole bytes, else empty
    std::vector<AnswerPart> parts;  ///< of ranges (206): they cover what was asked for
    bool lacks_ranges = false;      ///< a problem that single ranges may not have: some of several are missing
    std::int64_t total = -1;        ///< bytes of the file; -1: the server does not say
    std::string etag, last_modified, location;
    std::string problem;          ///< why none came, or not all of one
    bool is_certificate = false;  ///< the problem: who the server is, is not certain
};

/// Thread safe. Connections stay open for the next requests.
class HttpClient {
public:
    explicit HttpClient(const RemoteOptions& options);
    ~HttpClient();
    HttpClient(const HttpClient&) = delete;
    HttpClient& operator=(const HttpClient&) = delete;

    /// One answer for each set of ranges, in order; redirects are not followed. Answers that may be better next time (none, a part, a wrong
    /// range, 408, 429, 5xx) are asked for again, with pauses. Throws Error{cancelled}. max_whole: of a server that sends the file and not
    /// a range of it, this many bytes are taken.
    [[nodiscard]] std::vector<HttpAnswer> get(const Address& address, std::span<const RangeSet> ranges, std::int64_t max_whole);

    [[nodiscard]] RemoteTraffic traffic() const;

private:
    class Connections;
    struct Lease;
    [[nodiscard]] std::unique_ptr<Connections> take();
    void give_back(std::unique_ptr<Connections> connections);

    RemoteOptions options_;
    mutable std::mutex mutex_;
    std::vector<std::unique_ptr<Connections>> idle_;
    RemoteTraffic traffic_;
};

}  // namespace isoatlas
