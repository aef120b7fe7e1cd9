// What a viewer asks and what it is answered, without the network: server/http.cpp carries these, tests and fuzzers make them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "server/event_stream.h"
#include "server/job_queue.h"

namespace isoatlas {

struct Request {
    std::string path;                               ///< as sent, without what follows '?'
    std::multimap<std::string, std::string> words;  ///< what follows '?'
    std::string token;                              ///< who may ask; empty: none was sent
    std::string client;                             ///< who asks; of one client a newer request ends an older one for a surface
    IsDisconnected is_disconnected{};               ///< is nobody there any more to hear the answer?
};

struct Response {
    int status = 200;
    std::string type = "application/json";
    std::string bytes{};
    std::map<std::string, std::string> headers{};
    std::shared_ptr<EventStream> events{};  ///< instead of bytes: what is still to come
};

}  // namespace isoatlas
