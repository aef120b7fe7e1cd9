// What a client hears while it listens: where the server is, and where its own requests are (text/event-stream).
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

/// One client that listens. When the last stream of a client ends, so do its requests.
class EventStream {
public:
    EventStream(const EventStream&) = delete;
    EventStream& operator=(const EventStream&) = delete;
    ~EventStream();

    /// The next message; it may take long: until the state has changed, or a comment is due that tells that somebody is still there.
    /// Empty: nothing more will come. From one thread.
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

/// All of a server.
class EventStreams {
public:
    EventStreams(const StoreState& store_state, JobQueues& lines, VersionCounter& changes)
        : store_state_(store_state), queues_(lines), changes_(changes) {}

    /// Throws Error{resource} when too many listen. client: without a lane; empty: it has no requests.
    [[nodiscard]] std::shared_ptr<EventStream> listen(const std::string& client, IsDisconnected is_disconnected);
    /// Ends all streams, and those to come.
    void end();

private:
    friend class EventStream;

    const StoreState& store_state_;
    JobQueues& queues_;
    VersionCounter& changes_;
    std::atomic<bool> ended_ = false;
    std::mutex mutex_;
    std::multiset<std::string> clients_;
};

}  // namespace isoatlas
