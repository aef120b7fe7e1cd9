// Seconds by phase, as the library reports its progress.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <isoatlas/context.h>

namespace bench {

/// Sums time by the name of the phase.
class PhaseClock {
public:
    using Phases = std::vector<std::pair<std::string, double>>;  ///< in the order in which they began

    /// The same context, whose phases are timed by this clock, which must outlive it.
    [[nodiscard]] isoatlas::Context watched(isoatlas::Context context) {
        context.progress = [this](const isoatlas::Progress& progress) {
            if (progress.phase != current_) enter(std::string(progress.phase));
        };
        return context;
    }
    /// Ends the last phase.
    [[nodiscard]] const Phases& phases() {
        leave();
        return phases_;
    }

private:
    using Clock = std::chrono::steady_clock;

    void enter(const std::string& name) {
        leave();
        current_ = name;
        start_ = Clock::now();
    }
    void leave() {
        if (current_.empty()) return;
        const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        const auto known = std::find_if(phases_.begin(), phases_.end(), [this](const auto& phase) { return phase.first == current_; });
        if (known == phases_.end())
            phases_.emplace_back(current_, seconds);
        else
            known->second += seconds;
        current_.clear();
    }

    Phases phases_;
    std::string current_;
    Clock::time_point start_;
};

}  // namespace bench
