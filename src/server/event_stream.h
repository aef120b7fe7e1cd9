// Server-sent events of a client: state of the server, progress of its own requests (text/event-stream).
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "server/job_queues.h"
#include "server/store_state.h"
#include "server/version_counter.h"

namespace isoatlas {

class EventStreams;
class SharedScene;

/// The stream of one client. When the last stream of a client ends, its requests are cancelled.
class EventStream {
public:
    EventStream(const EventStream&) = delete;
    EventStream& operator=(const EventStream&) = delete;
    ~EventStream();

    /// The next message; blocks until the state has changed or a keep-alive comment is due. Empty: end of the stream. From one thread.
    [[nodiscard]] std::string next();

private:
    friend class EventStreams;
    EventStream(EventStreams& streams, std::string client, IsDisconnected is_disconnected);
    [[nodiscard]] std::string state() const;

    EventStreams& streams_;
    const std::string client_;
    const IsDisconnected is_disconnected_;
    std::string told_;  ///< the last message
    std::uint64_t seen_ = 0;
    std::chrono::steady_clock::time_point last_{};
};

/// All streams of a server.
class EventStreams {
public:
    EventStreams(const StoreState& store_state, JobQueues& lines, const SharedScene& scene, VersionCounter& changes)
        : store_state_(store_state), queues_(lines), scene_(scene), changes_(changes) {}

    /// Throws Error{resource} when there are too many streams. client: without a lane; empty: it has no requests.
    [[nodiscard]] std::shared_ptr<EventStream> listen(const std::string& client, IsDisconnected is_disconnected);
    /// Ends all streams, also future ones.
    void end();

private:
    friend class EventStream;

    const StoreState& store_state_;
    JobQueues& queues_;
    const SharedScene& scene_;
    VersionCounter& changes_;
    std::atomic<bool> ended_ = false;
    std::mutex mutex_;
    std::multiset<std::string> clients_;
};

}  // namespace isoatlas
