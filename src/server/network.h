// Connections: a bounded number of unauthorised ones; authorised requests are answered by threads.
//
// One thread accepts, reads request heads and checks deadlines; it never blocks on a client. There are at most kMaxStrangers connections
// whose request is not yet authorised, each with a head of at most kLongestHead bytes and kHeadTime for all of it; when another one
// arrives, the oldest is closed, so they cannot keep others out. Each authorised request is answered by a thread of its own, at most
// kMaxAtOnce at a time. Idle connections between two authorised requests are kept for a while and counted separately. The body of a request
// is read by that thread: at_the_door() has bounded its length.
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
constexpr int kMaxBodies = 4;  ///< requests with a body at a time
constexpr std::chrono::seconds kHeadTime{5}, kBodyTime{10}, kIdleTime{30}, kLeavingTime{1};

class Network {
public:
    struct Answers {
        /// The whole response to an unauthorised request; nullopt: it is authorised. Must be fast: called on the thread of all connections.
        std::function<std::optional<std::string>(const RequestHead&)> at_the_door;
        /// The whole response to an invalid request, or to one too many.
        std::function<std::string(int status)> refusal;
        /// Answers a request, on a thread of its own. True: the connection may be reused.
        std::function<bool(const RequestHead&, const std::string& body, const Peer&)> answer;
    };

    /// Listens on 127.0.0.1. port: 0: any. or_any: also where the port is taken. Throws Error{resource}.
    Network(int port, bool or_any, Answers answers);
    Network(const Network&) = delete;
    Network& operator=(const Network&) = delete;
    ~Network();

    [[nodiscard]] int port() const;
    /// Runs until stop() is called; all responses have ended when it returns.
    void run();
    /// From any thread, before or after run() has begun.
    void stop();

private:
    class Connections;
    std::unique_ptr<Connections> connections_;
};

}  // namespace isoatlas
