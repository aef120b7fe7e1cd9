// A counter of changes that other threads can wait on.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace isoatlas {

/// From many threads.
class VersionCounter {
public:
    void note() {
        const std::lock_guard lock(mutex_);
        ++count_;
        changed_.notify_all();
    }
    [[nodiscard]] std::uint64_t count() const {
        const std::lock_guard lock(mutex_);
        return count_;
    }
    /// Returns when the count differs from `seen`, at the latest after `max`.
    void wait(std::uint64_t seen, std::chrono::milliseconds max) const {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, max, [&] { return count_ != seen; });
    }
    /// Sleeps for that time, regardless of changes.
    void pause(std::chrono::milliseconds time) const {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, time, [] { return false; });
    }

private:
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    std::uint64_t count_ = 0;
};

}  // namespace isoatlas
