// Connections: strangers wait at the door, whoever may ask is answered by a thread.
//
// One thread accepts, reads heads of requests and watches deadlines; it never waits for a client. A connection whose request has not yet
// been let in belongs to a stranger: there are at most kMaxStrangers, each with a head of kLongestHead bytes and kHeadTime for all of it;
// when another one comes, the oldest is cut off. So whoever holds all of them does not keep others out. What is let in is answered by a
// thread of its own, at most kMaxAtOnce at a time. Between two requests a connection keeps its place for a while, apart from the
// strangers.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/peer.h"
#include "server/request_head.h"

namespace isoatlas {

constexpr int kMaxAtOnce = 160, kMaxStrangers = 256, kMaxIdle = 160;
constexpr std::chrono::seconds kHeadTime{5}, kIdleTime{30}, kLeavingTime{1};

class Network {
public:
    struct Answers {
        /// A whole answer for whoever is not let in; nothing: he is. Must be quick: it is asked on the thread of all connections.
        std::function<std::optional<std::string>(const RequestHead&)> at_the_door;
        /// The same for what is no request, or one too many.
        std::function<std::string(int status)> refusal;
        /// Answers a request, on a thread of its own. True: the connection may go on.
        std::function<bool(const RequestHead&, const Peer&)> answer;
    };

    /// Listens on 127.0.0.1. port: 0: any. Throws Error{resource}.
    Network(int port, Answers answers);
    Network(const Network&) = delete;
    Network& operator=(const Network&) = delete;
    ~Network();

    [[nodiscard]] int port() const;
    /// Until stop() is called; all answers have ended when it returns.
    void run();
    /// From any thread, before or after run() has begun.
    void stop();

private:
    class Connections;
    std::unique_ptr<Connections> connections_;
};

}  // namespace isoatlas
