#include "base/workers.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "isoatlas/environment.h"

namespace isoatlas {

Workers::~Workers() {
    wait();
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

bool Workers::post(std::function<void()> job) {
    const std::lock_guard lock(mutex_);
    jobs_.emplace_back([environment = current_environment(), job = std::move(job)] {
        const EnvironmentScope scope(environment);
        job();
    });
    if (idle_ < std::ssize(jobs_) && std::ssize(threads_) < max_) {
        try {
            threads_.reserve(threads_.size() + 1);
            threads_.emplace_back([this] { work(); });
            ++idle_;                       // it takes the next job
        } catch (const std::exception&) {  // std::system_error, std::bad_alloc: existing threads run the job later
            if (threads_.empty()) {
                jobs_.pop_back();
                return false;
            }
        }
    }
    changed_.notify_all();
    return true;
}

void Workers::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return jobs_.empty() && idle_ == std::ssize(threads_); });
}

void Workers::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return ends_ || !jobs_.empty(); });
        if (jobs_.empty()) return;
        const std::function<void()> job = std::move(jobs_.front());
        jobs_.pop_front();
        --idle_;
        lock.unlock();
        job();
        lock.lock();
        ++idle_;
        changed_.notify_all();
    }
}

}  // namespace isoatlas
