#include "call.h"

#include <string>

namespace py = pybind11;

namespace isoatlas::python {
namespace {

constexpr std::chrono::milliseconds kBetweenSignals{20}, kBetweenReports{50};

}  // namespace

Watch::Watch(const CallOptions& options) : progress_(options.progress) {
    context_.threads = options.threads;
    context_.cancelled = [this] { return looks_for_signals(); };
    if (progress_ && !progress_.is_none()) context_.progress = [this](const Progress& progress) { report(progress); };
}

template <class Function>
bool Watch::held(const Function& function) {
    const py::gil_scoped_acquire acquired;
    try {
        function();
    } catch (py::error_already_set& raised) {
        pending_.emplace(std::move(raised));
    }
    return !pending_;
}

/// Only the main thread of Python handles signals; on others this finds nothing.
bool Watch::looks_for_signals() {
    if (pending_) return true;
    const Clock::time_point now = Clock::now();
    if (now - looked_ < kBetweenSignals) return false;
    looked_ = now;
    return !held([] {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    });
}

void Watch::report(const Progress& progress) {
    if (pending_) return;
    const Clock::time_point now = Clock::now();
    const bool is_last = progress.fraction >= 1 && progress.phase_index + 1 >= progress.phase_count;
    if (!is_last && now - reported_ < kBetweenReports) return;
    reported_ = now;
    held([&] { progress_(std::string(progress.phase), (progress.phase_index + progress.fraction) / std::max(1, progress.phase_count)); });
}

void Watch::raise_pending() {
    if (!pending_) return;
    py::error_already_set raised = std::move(*pending_);
    pending_.reset();
    throw raised;
}

}  // namespace isoatlas::python
