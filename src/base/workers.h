// Workers: thread pool for jobs that mostly wait, such as requests of clients. Threads are started on demand and stay.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace isoatlas {

class Workers {
public:
    /// max: number of threads.
    explicit Workers(int max) : max_(max) {}
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    /// Waits for all jobs.
    ~Workers();

    /// Thread safe. The job begins when a thread is free, in the environment of the caller; it must not throw. False: there is no thread,
    /// and the system refuses one.
    [[nodiscard]] bool post(std::function<void()> job);
    /// Returns when no job waits or runs.
    void wait();

private:
    void work();

    const int max_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> jobs_;
    std::vector<std::thread> threads_;
    int idle_ = 0;
    bool ends_ = false;
};

}  // namespace isoatlas
