// The job queues of the server, by the data that responses need.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "server/job_queue.h"

namespace isoatlas {

enum class QueueClass : std::uint8_t {
    surfaces,  ///< surfaces, labels, measures
    samples,   ///< samples of bricks
    trees,     ///< queries on the trees
    cards,     ///< pictures; low priority
    atlas,     ///< no queue: all wait for the same result
};

class JobQueues {
public:
    /// changes: notified of every change; it must live as long.
    explicit JobQueues(VersionCounter& changes);

    [[nodiscard]] JobQueue& of(QueueClass line) { return queues_[static_cast<std::size_t>(line)]; }
    /// JobQueue::leave() and end() of all.
    void leave(const std::string& name);
    void end();

    struct Pending {
        const char* line;  ///< "surfaces", ...
        JobQueue::Pending request;
    };
    /// JobQueue::pending() of all queues, one after the other.
    [[nodiscard]] std::vector<Pending> pending(const std::string& name) const;

private:
    std::array<JobQueue, 5> queues_;
};

}  // namespace isoatlas
