// Bounded FIFO of jobs: a few run at a time, the others wait in order of arrival. A newer request of a client supersedes its older one and
// takes its place in the queue. A job is cancelled too when its client has disconnected.
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

/// Has the client disconnected? Polled from the thread that waits or works. Empty: connected.
using IsDisconnected = std::function<bool()>;

class JobQueue {
public:
    /// waiting: max waiting jobs. changes: notified of every change; it must live as long.
    JobQueue(int max_running, int waiting, VersionCounter* changes = nullptr)
        : max_running_(max_running), max_waiting_(waiting), changes_(changes) {}

    /// A running job; its place is free when it is destroyed.
    class Job {
    public:
        Job(const Job&) = delete;
        Job& operator=(const Job&) = delete;
        ~Job();
        /// Superseded by a newer request of the same client, client disconnected, or server ended?
        [[nodiscard]] bool is_cancelled();
        /// fraction: completed part of the work, 0 to 1.
        void report_progress(double fraction);

    private:
        friend class JobQueue;
        Job(JobQueue& queue, std::string client, IsDisconnected is_disconnected)
            : jobs_(queue), client_(std::move(client)), is_disconnected_(std::move(is_disconnected)) {}

        JobQueue& jobs_;
        const std::string client_;
        const IsDisconnected is_disconnected_;
        // under the mutex of jobs_:
        std::uint64_t place_ = 0;  ///< position in the queue; 0: not waiting
        double fraction_ = 0;
        bool running_ = false, ended_ = false;
    };

    /// Blocks until the job of this client may run. Throws Error: cancelled (superseded, client disconnected, or server ended), resource
    /// (queue full). An empty client is a different one each time.
    [[nodiscard]] std::unique_ptr<Job> acquire(const std::string& client, IsDisconnected is_disconnected = {});
    /// Cancels the jobs of a client: of NAME and of NAME/ANYTHING.
    void leave(const std::string& name);
    /// Cancels all jobs; acquire() throws from now on.
    void end();

    /// Number of waiting jobs.
    [[nodiscard]] int waiting() const;
    [[nodiscard]] int running() const;

    /// A job that is not finished.
    struct Pending {
        std::string client;
        int place = 0;        ///< place in the queue, from 1; 0: running
        double fraction = 0;  ///< of that
    };
    /// Jobs of NAME and of NAME/ANYTHING, by client.
    [[nodiscard]] std::vector<Pending> pending(const std::string& name) const;

private:
    [[nodiscard]] bool may_run(const Job& job) const;
    /// Removes the job from the waiting ones.
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
