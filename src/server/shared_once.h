// A value computed once for all concurrent callers; cancelled when no caller waits for it any more.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "base/cancel.h"

namespace isoatlas {

/// From many threads.
template <class T>
class SharedOnce {
public:
    /// Null: not computed yet.
    [[nodiscard]] const T* there() const { return there_.load(); }

    /// The first caller runs make(context) on its thread; it is cancelled when no waiting caller needs the value any more. Other callers
    /// block. Throws Error{cancelled} when this caller is cancelled; rethrows what make throws, and the next caller runs it again.
    template <class Make>
    [[nodiscard]] const T& get(const Context& context, const Make& make) {
        if (const T* made = there()) return *made;
        std::unique_lock lock(mutex_);
        const Waiter waiter(*this, context);
        while (value_ == nullptr && is_being_made_) {
            changed_.wait_for(lock, kLook);
            stop_if_cancelled(context);
        }
        if (value_ == nullptr) make_it(lock, context, make);
        return *value_;
    }

private:
    static constexpr std::chrono::milliseconds kLook{50};  ///< polling interval of a waiting caller for its cancellation

    /// Requires the mutex.
    class Waiter {
    public:
        Waiter(SharedOnce& shared, const Context& context) : waiters_(shared.waiters_), context_(&context) { waiters_.push_back(context_); }
        Waiter(const Waiter&) = delete;
        Waiter& operator=(const Waiter&) = delete;
        ~Waiter() { std::erase(waiters_, context_); }

    private:
        std::vector<const Context*>& waiters_;
        const Context* context_;
    };

    [[nodiscard]] bool is_unwanted() {
        const std::lock_guard lock(mutex_);
        for (const Context* waiter : waiters_) {
            if (!waiter->cancelled || !waiter->cancelled()) return false;
        }
        return true;
    }

    template <class Make>
    void make_it(std::unique_lock<std::mutex>& lock, const Context& context, const Make& make) {
        is_being_made_ = true;
        lock.unlock();
        std::unique_ptr<T> made;
        try {
            Context own = context;
            own.progress = {};
            own.cancelled = [this] { return is_unwanted(); };
            made = std::make_unique<T>(make(own));
        } catch (...) {
            lock.lock();
            is_being_made_ = false;
            changed_.notify_all();
            throw;
        }
        lock.lock();
        value_ = std::move(made);
        there_ = value_.get();
        is_being_made_ = false;
        changed_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::unique_ptr<const T> value_;
    std::atomic<const T*> there_ = nullptr;
    std::vector<const Context*> waiters_;
    bool is_being_made_ = false;
};

}  // namespace isoatlas
