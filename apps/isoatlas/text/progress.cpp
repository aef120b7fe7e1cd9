#include "text/progress.h"

#include <algorithm>
#include <cmath>

#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>

#include "text/terminal.h"
#include "text/values.h"

namespace isoatlas::cli {
namespace {

constexpr double kQuietStart = 0.5;  // short jobs show no bar
constexpr double kRedraw = 0.1, kLineEvery = 10;

/// Peak resident memory in bytes.
double peak_memory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024;
}

std::string minutes_text(long seconds) { return fmt::format("{}:{:02}", seconds / 60, seconds % 60); }

void to_stderr(const std::string& text) { [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size()); }

}  // namespace

std::string progress_line(const Progress& progress, double phase_seconds, bool bar) {
    constexpr int width = 24;
    const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
    const int full = static_cast<int>(fraction * width);
    std::string line = fmt::format("[{}/{}] {:<16}", progress.phase_index + 1, progress.phase_count, progress.phase);
    if (progress.fraction < 0) return line + "  " + minutes_text(static_cast<long>(phase_seconds));
    if (bar) line += fmt::format(" {}{}", std::string(full, '#'), std::string(width - full, '.'));
    line += fmt::format(" {:3.0f} %", 100 * fraction);
    if (fraction > 0.01 && fraction < 1 && phase_seconds > 0.2) {
        const auto left = static_cast<long>(std::ceil(phase_seconds * (1 - fraction) / fraction));
        line += "  ETA " + minutes_text(left);
        if (progress.voxels > 0)
            line += fmt::format("  {:.3g} million voxels/s", 1e-6 * fraction * static_cast<double>(progress.voxels) / phase_seconds);
    }
    if (progress.voxels > 0) line += "  peak " + bytes_text(peak_memory());
    return line;
}

ProgressBar::ProgressBar(Terminal& terminal) : terminal_(terminal), start_(Clock::now()), last_(start_), phase_start_(start_) {}

ProgressBar::~ProgressBar() {
    if (drawn_) to_stderr("\r\033[K");
}

void ProgressBar::update(const Progress& progress) {
    if (terminal_.style().quiet) return;
    const Clock::time_point now = Clock::now();
    if (progress.phase_index != phase_) {
        phase_ = progress.phase_index;
        phase_start_ = now;
    }
    const double since_start = std::chrono::duration<double>(now - start_).count();
    const double since_last = std::chrono::duration<double>(now - last_).count();
    const bool interactive = terminal_.is_interactive();
    if (since_start < kQuietStart || since_last < (interactive ? kRedraw : kLineEvery)) return;
    last_ = now;
    draw(progress, std::chrono::duration<double>(now - phase_start_).count());
}

void ProgressBar::draw(const Progress& progress, double seconds) {
    if (terminal_.is_interactive()) {
        to_stderr("\r\033[K" + progress_line(progress, seconds, true));
        drawn_ = true;
    } else {
        terminal_.say(progress_line(progress, seconds, false));
    }
}

}  // namespace isoatlas::cli
