// Long calls: the interpreter is released, Ctrl-C and progress come through.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include <pybind11/pybind11.h>

#include <isoatlas/context.h>

namespace isoatlas::python {

/// What Python says about a long call.
struct CallOptions {
    int threads = 0;              ///< of Context
    pybind11::object progress{};  ///< None, or called with the phase and the part of the whole, 0 to 1
};

/// Something that Python must release, kept alive from C++: its last owner may be any thread.
[[nodiscard]] std::shared_ptr<const pybind11::object> keep_alive(pybind11::object object);

/// One long call. Its work runs on a thread of its own while the main thread of Python, the only one that handles signals, looks for them;
/// called from another thread of Python it runs on that.
class LongCall {
public:
    /// With the interpreter held.
    explicit LongCall(const CallOptions& options);
    LongCall(const LongCall&) = delete;
    LongCall& operator=(const LongCall&) = delete;
    ~LongCall() = default;

    [[nodiscard]] const Context& context() const { return context_; }
    /// With the interpreter held: runs work() without it. Throws what it throws, and what a signal handler or the progress callback raises.
    /// After a signal work() is cancelled; what does not stop within a moment is left to end alone, so it must own what it uses.
    static void run(const std::shared_ptr<LongCall>& self, std::function<void()> work);

private:
    void run_beside(const std::shared_ptr<LongCall>& self, std::function<void()> work);
    void report(const Progress& progress);
    void finish();
    bool is_done_within(std::chrono::milliseconds time);
    bool raises_signal();
    void raise();

    Context context_;
    std::shared_ptr<const pybind11::object> progress_;
    std::chrono::steady_clock::time_point reported_{};
    std::atomic<bool> is_cancelled_ = false;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool is_done_ = false;
    std::exception_ptr error_;                           ///< of work()
    std::optional<pybind11::error_already_set> raised_;  ///< in Python
};

/// At the end of the interpreter: waits for work that was left alone.
void wait_for_abandoned_calls();
/// Before work that needs what abandoned work may still hold, such as the lock of a store. Throws what a signal handler raises.
void wait_for_abandoned_calls_or_signal();

/// function(const Context&) without the interpreter, as LongCall::run() does; its result. It captures by value, or shared pointers.
template <class Function>
auto long_call(const CallOptions& options, Function function) {
    using Result = std::invoke_result_t<Function&, const Context&>;
    using Kept = std::conditional_t<std::is_void_v<Result>, std::monostate, std::optional<Result>>;
    struct Work {
        Function function;
        Kept result{};
    };
    const auto call = std::make_shared<LongCall>(options);
    const auto work = std::make_shared<Work>(Work{std::move(function)});
    LongCall::run(call, [&context = call->context(), work] {
        if constexpr (std::is_void_v<Result>) {
            work->function(context);
        } else {
            work->result.emplace(work->function(context));
        }
    });
    if constexpr (!std::is_void_v<Result>) return std::move(*work->result);
}

/// function() without the interpreter, on this thread: for what cannot be cancelled, such as writing a file.
template <class Function>
auto released(Function&& function) {
    const pybind11::gil_scoped_release free;
    return function();
}

}  // namespace isoatlas::python
