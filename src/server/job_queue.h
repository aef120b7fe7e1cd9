// Whose turn it is: a few surfaces are made at a time, others wait in the order in which they came; a newer request of the same client
// ends an older one, and takes its place where that still waits. A request ends too when who asked has left.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/version_counter.h"

namespace isoatlas {

/// Is nobody there any more to hear the answer? Asked now and then, from the thread that waits or works. Empty: somebody is.
using IsDisconnected = std::function<bool()>;

class JobQueue {
public:
    /// at_once: so many hold a turn; waiting: so many more may wait for one. changes: is told of every change; it must live as long.
    JobQueue(int max_running, int waiting, VersionCounter* changes = nullptr)
        : max_running_(max_running), max_waiting_(waiting), changes_(changes) {}

    /// Held while a surface is made.
    class Job {
    public:
        Job(const Job&) = delete;
        Job& operator=(const Job&) = delete;
        ~Job();
        /// Has a newer request of the same client come, has who asked left, or does the server end?
        [[nodiscard]] bool is_cancelled();
        /// How much of the work is done, 0 to 1.
        void report_progress(double fraction);

    private:
        friend class JobQueue;
        Job(JobQueue& queue, std::string client, IsDisconnected is_disconnected)
            : jobs_(queue), client_(std::move(client)), is_disconnected_(std::move(is_disconnected)) {}

        JobQueue& jobs_;
        const std::string client_;
        const IsDisconnected is_disconnected_;
        // under the mutex of jobs_:
        std::uint64_t place_ = 0;  ///< in the order of waiting; 0: it does not wait
        double fraction_ = 0;
        bool running_ = false, ended_ = false;
    };

    /// Waits until it is this client's turn. Throws Error: cancelled (a newer request came, who asked has left, or the server ends),
    /// resource (too many wait). An empty client is one of its own each time.
    [[nodiscard]] std::unique_ptr<Job> acquire(const std::string& client, IsDisconnected is_disconnected = {});
    /// Ends what a client has asked: the requests of NAME and of NAME/ANYTHING.
    void leave(const std::string& name);
    /// Ends all turns; take() refuses from now on.
    void end();

    /// How many wait.
    [[nodiscard]] int waiting() const;
    [[nodiscard]] int running() const;

    /// A request that is not yet answered.
    struct Pending {
        std::string client;
        int place = 0;        ///< in the queue, from 1; 0: its answer is being made
        double fraction = 0;  ///< of that
    };
    /// Those of NAME and of NAME/ANYTHING, by client.
    [[nodiscard]] std::vector<Pending> pending(const std::string& name) const;

private:
    [[nodiscard]] bool may_run(const Job& job) const;
    /// The turn no longer waits.
    void activate(Job& job);
    void notify_waiting();

    const int max_running_, max_waiting_;
    VersionCounter* const changes_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Job*> jobs_;                 ///< that live
    std::map<std::uint64_t, Job*> waiting_;  ///< by place
    std::uint64_t next_place_ = 0;
    int running_ = 0;
    bool ended_ = false;
};

}  // namespace isoatlas
