// Polling of Context::cancelled in long calls.
#pragma once

#include <thread>

#include "isoatlas/context.h"
#include "isoatlas/error.h"

namespace isoatlas {

/// Throws Error{cancelled} when the caller has cancelled.
inline void stop_if_cancelled(const Context& context) {
    if (context.cancelled && context.cancelled()) throw Error(ErrorKind::cancelled, {.what = "cancelled"});
}

/// The same for work shared by several threads: polls on the thread that constructed it, does nothing on the others.
class CallerLooks {
public:
    explicit CallerLooks(const Context& context) : context_(context) {}
    void operator()() const {
        if (is_caller()) stop_if_cancelled(context_);
    }
    [[nodiscard]] bool is_caller() const { return std::this_thread::get_id() == caller_; }

private:
    const Context& context_;
    const std::thread::id caller_ = std::this_thread::get_id();
};

}  // namespace isoatlas
