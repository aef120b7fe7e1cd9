// Requests and responses, independent of the network: server/http.cpp transports them, tests and fuzzers construct them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "isoatlas/polarity.h"
#include "server/event_stream.h"
#include "server/job_queue.h"

namespace isoatlas {

struct Request {
    std::string path;                               ///< as sent, up to '?'
    std::multimap<std::string, std::string> words;  ///< query parameters
    std::string token;                              ///< empty: none was sent
    std::string client;                             ///< a newer surface request of a client supersedes its older one
    IsDisconnected is_disconnected{};               ///< has the client disconnected?
    bool is_change = false;                         ///< PUT: may change something
    std::string body{};
    std::optional<Polarity> polarity{};  ///< which objects, the parameter `polarity`; none: of high values if the store holds them
};

struct Response {
    int status = 200;
    std::string type = "application/json";
    std::string bytes{};
    std::map<std::string, std::string> headers{};
    std::shared_ptr<EventStream> events{};  ///< instead of bytes: a stream
    bool may_be_framed = false;             ///< by pages of any site
};

/// Bytes of a file, or of a mesh.
[[nodiscard]] inline Response file_answer(std::string bytes) { return {200, "application/octet-stream", std::move(bytes)}; }

}  // namespace isoatlas
