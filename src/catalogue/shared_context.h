// The context of work that several threads share.
#pragma once

#include <atomic>

#include "base/cancel.h"

namespace isoatlas {

/// A context that any thread may ask: only the thread that constructed this asks the caller's, whether it is cancelled, the others learn of
/// it. It reports no progress.
class SharedContext {
public:
    explicit SharedContext(const Context& context) : given_(context), look_(context), own_(context) {
        own_.progress = nullptr;
        own_.cancelled = [this] {
            if (given_.cancelled && look_.is_caller() && given_.cancelled()) is_cancelled_ = true;
            return is_cancelled_.load();
        };
    }
    SharedContext(const SharedContext&) = delete;
    SharedContext& operator=(const SharedContext&) = delete;
    ~SharedContext() = default;

    [[nodiscard]] const Context& context() const { return own_; }
    void set_threads(int threads) { own_.threads = threads; }
    [[nodiscard]] bool is_caller() const { return look_.is_caller(); }

private:
    const Context& given_;
    const CallerLooks look_;
    std::atomic<bool> is_cancelled_ = false;
    Context own_;
};

}  // namespace isoatlas
