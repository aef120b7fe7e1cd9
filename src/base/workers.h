// Threads for work that mostly waits, such as the questions of clients. They are started when they are needed and stay.
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
    /// most: threads.
    explicit Workers(int max) : max_(max) {}
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    /// Waits for all jobs.
    ~Workers();

    /// From any thread. The job begins when a thread is free; it must not throw. False: the system gives no thread, and there is none.
    [[nodiscard]] bool post(std::function<void()> job);
    /// Until no job waits or runs.
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
