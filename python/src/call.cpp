#include "call.h"

#include <algorithm>
#include <string>
#include <thread>

namespace py = pybind11;

namespace isoatlas::python {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds kBetweenSignals{20}, kBetweenReports{50};
constexpr milliseconds kLastChance{50};  ///< for work that is cancelled

/// Work that was left alone and runs on.
struct Abandoned {
    std::mutex mutex;
    std::condition_variable changed;
    int count = 0;
};
Abandoned& abandoned() {
    static auto* const all = new Abandoned;  // threads may use it until the process ends
    return *all;
}

/// Is this the thread that handles signals?
bool is_main_thread() {
    const py::object main = py::module_::import("threading").attr("main_thread")();
    return main.attr("ident").cast<unsigned long>() == PyThread_get_thread_ident();
}

}  // namespace

std::shared_ptr<const py::object> keep_alive(py::object object) {
    const auto release = [](const py::object* kept) {
        if (Py_IsInitialized() == 0) return;  // the interpreter has ended, and its memory with it
        const py::gil_scoped_acquire acquired;
        delete kept;
    };
    return {new py::object(std::move(object)), release};
}

LongCall::LongCall(const CallOptions& options) {
    context_.threads = options.threads;
    context_.cancelled = [this] { return is_cancelled_.load(); };
    if (!options.progress || options.progress.is_none()) return;
    progress_ = keep_alive(options.progress);
    context_.progress = [this](const Progress& progress) { report(progress); };
}

void LongCall::report(const Progress& progress) {
    if (is_cancelled_) return;
    const auto now = std::chrono::steady_clock::now();
    const bool is_last = progress.fraction >= 1 && progress.phase_index + 1 >= progress.phase_count;
    if (!is_last && now - reported_ < kBetweenReports) return;
    reported_ = now;
    const py::gil_scoped_acquire acquired;
    if (is_cancelled_) return;  // meanwhile
    try {
        const double part = (progress.phase_index + progress.fraction) / std::max(1, progress.phase_count);
        (*progress_)(std::string(progress.phase), std::clamp(part, 0.0, 1.0));
    } catch (py::error_already_set& raised) {
        raised_.emplace(std::move(raised));
        is_cancelled_ = true;
    }
}

void LongCall::finish() {
    const std::scoped_lock lock(mutex_);
    is_done_ = true;
    ended_.notify_all();
}

bool LongCall::is_done_within(milliseconds time) {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, time, [this] { return is_done_; });
}

bool LongCall::raises_signal() {
    const py::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() == 0) return false;
    raised_.emplace();  // takes what is raised
    return true;
}

void LongCall::raise() {
    if (raised_) {
        py::error_already_set raised = std::move(*raised_);
        raised_.reset();
        throw raised;
    }
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void LongCall::run_beside(const std::shared_ptr<LongCall>& self, std::function<void()> work) {
    std::thread([self, work = std::move(work)]() mutable {
        try {
            work();
        } catch (...) {
            self->error_ = std::current_exception();
        }
        work = nullptr;  // what it owns is free before the caller goes on
        self->finish();
    }).detach();
    while (!is_done_within(kBetweenSignals)) {
        if (!raises_signal()) continue;
        is_cancelled_ = true;
        if (is_done_within(kLastChance)) return;
        {
            const std::scoped_lock lock(abandoned().mutex);
            ++abandoned().count;
        }
        std::thread([self] {
            while (!self->is_done_within(std::chrono::hours(1))) continue;
            const std::scoped_lock lock(abandoned().mutex);
            --abandoned().count;
            abandoned().changed.notify_all();
        }).detach();
        return;
    }
}

void LongCall::run(const std::shared_ptr<LongCall>& self, std::function<void()> work) {
    const bool is_main = is_main_thread();
    {
        const py::gil_scoped_release free;
        if (is_main) {
            self->run_beside(self, std::move(work));
        } else {
            try {
                work();
            } catch (...) {
                self->error_ = std::current_exception();
            }
        }
    }
    self->raise();
}

void wait_for_abandoned_calls() {
    const py::gil_scoped_release free;
    std::unique_lock lock(abandoned().mutex);
    abandoned().changed.wait(lock, [] { return abandoned().count == 0; });
}

void wait_for_abandoned_calls_or_signal() {
    const auto are_done = [] {
        const py::gil_scoped_release free;
        std::unique_lock lock(abandoned().mutex);
        return abandoned().changed.wait_for(lock, kBetweenSignals, [] { return abandoned().count == 0; });
    };
    while (!are_done())
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace isoatlas::python
