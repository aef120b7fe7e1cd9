// Progress on standard error: a bar with ETA on a terminal, a line every ten seconds otherwise, nothing with --quiet.
#pragma once

#include <chrono>
#include <string>

#include <isoatlas/context.h>

namespace isoatlas::cli {

class Terminal;

inline constexpr double kUnknownFraction = -1;  ///< Progress::fraction of a phase that cannot tell: its time is shown instead

class ProgressBar {
public:
    explicit ProgressBar(Terminal& terminal);
    ~ProgressBar();  ///< clears the line
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void update(const Progress& progress);

private:
    using Clock = std::chrono::steady_clock;
    void draw(const Progress& progress, double seconds);

    Terminal& terminal_;
    Clock::time_point start_, last_, phase_start_;
    int phase_ = -1;
    bool drawn_ = false;
};

/// "[2/5] join tree  #######...  71 %  ETA 0:19"; of an unknown fraction "[2/5] join tree  0:19"
[[nodiscard]] std::string progress_line(const Progress& progress, double phase_seconds, bool bar);

}  // namespace isoatlas::cli
