// Long calls: the interpreter is released, Ctrl-C and progress come through.
#pragma once

#include <chrono>
#include <optional>
#include <utility>

#include <pybind11/pybind11.h>

#include <isoatlas/context.h>

namespace isoatlas::python {

/// What Python says about a long call.
struct CallOptions {
    int threads = 0;                     ///< of Context
    pybind11::object progress{};         ///< None, or called with the phase and the part of the whole, 0 to 1
};

/// Looks after one call: is made and destroyed with the interpreter held, used without it on the thread of the call.
class Watch {
public:
    explicit Watch(const CallOptions& options);
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    ~Watch() = default;

    /// Valid as long as this lives.
    [[nodiscard]] const Context& context() const { return context_; }
    /// With the interpreter held: raises what a signal handler or the progress callback has raised.
    void raise_pending();

private:
    using Clock = std::chrono::steady_clock;

    bool looks_for_signals();
    void report(const Progress& progress);
    /// Runs function() with the interpreter held, keeps what it raises; false: it raised.
    template <class Function>
    bool held(const Function& function);

    Context context_;
    pybind11::object progress_;
    Clock::time_point looked_{}, reported_{};
    std::optional<pybind11::error_already_set> pending_;
};

/// function(const Context&) without the interpreter; its result. Raises KeyboardInterrupt after Ctrl-C.
template <class Function>
auto long_call(const CallOptions& options, Function&& function) {
    Watch watch(options);
    try {
        const pybind11::gil_scoped_release released;
        return function(watch.context());
    } catch (...) {
        watch.raise_pending();
        throw;
    }
}

}  // namespace isoatlas::python
