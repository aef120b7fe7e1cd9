// Progress and remaining time of a build, from the progress of its phases.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/memory_limit.h"
#include "isoatlas/build.h"

namespace isoatlas {
namespace {

/// Start of each phase as a fraction of the build time: read, classify, two without progress, trees, zones, objects, pack.
constexpr std::array kShares{0.0, 0.03, 0.17, 0.17, 0.17, 0.25, 0.4, 0.83, 1.0};
constexpr int kPhasesOfPass = 6;                         ///< from classify to objects, once for each polarity
constexpr double kOnePass = kShares[7] - kShares[1];     ///< of a build of one polarity
constexpr double kEnoughToTell = 0.02, kShortest = 0.5;  ///< min fraction and seconds for an estimate
constexpr std::chrono::milliseconds kMeasureEvery{100};  ///< memory: the system takes longer than a brick is packed

/// Fraction of the whole build.
double fraction_of(const Progress& progress) {
    const double part = std::clamp(progress.fraction, 0.0, 1.0);
    const int passes = (progress.phase_count - 2) / kPhasesOfPass, last = progress.phase_count - 1;
    if (passes < 1 || progress.phase_count != 2 + passes * kPhasesOfPass) return 0;
    const int index = std::clamp(progress.phase_index, 0, last);
    const int pass = index == 0 ? 0 : index == last ? passes - 1 : (index - 1) / kPhasesOfPass;
    const auto phase = static_cast<std::size_t>(index - pass * kPhasesOfPass);
    return (std::lerp(kShares[phase], kShares[phase + 1], part) + pass * kOnePass) / (1 + (passes - 1) * kOnePass);
}

}  // namespace

BuildState BuildClock::at(const Progress& progress) {
    const auto now = Clock::now();
    const double fraction = std::max(fraction_of(progress), furthest_);
    if (!start_) start_ = now, first_ = fraction;
    if (progress.phase_index != phase_) phase_ = progress.phase_index, phase_start_ = now, first_of_phase_ = progress.fraction;
    furthest_ = fraction;
    if (!measured_ || now - *measured_ >= kMeasureEvery) measured_ = now, peak_ = peak_memory();
    BuildState state{.phase = std::string(progress.phase),
                     .phase_index = progress.phase_index,
                     .phase_count = progress.phase_count,
                     .fraction = fraction,
                     .peak_memory = peak_};
    const double seconds = std::chrono::duration<double>(now - *start_).count();
    if (fraction > first_ + kEnoughToTell && seconds > kShortest) state.seconds_left = seconds * (1 - fraction) / (fraction - first_);
    const double of_phase = std::chrono::duration<double>(now - *phase_start_).count(), done = progress.fraction - first_of_phase_;
    if (progress.voxels > 0 && of_phase > kShortest && done > 0)
        state.voxels_per_second = done * static_cast<double>(progress.voxels) / of_phase;
    return state;
}

}  // namespace isoatlas
