// How often something has changed, so that others can wait for the next time.
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
    /// Returns once there have been more than `seen`, at the latest after `most`.
    void wait(std::uint64_t seen, std::chrono::milliseconds max) const {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, max, [&] { return count_ != seen; });
    }
    /// Returns after that time, whatever changes.
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
