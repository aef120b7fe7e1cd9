#include "measure.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>

#include "phase_clock.h"
#include "yardstick.h"

namespace bench {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

Answer answer_of(const isoatlas::Analysis& analysis) {
    Answer answer{analysis.element_count(), 0, analysis.event_count(), analysis.contour_arc_count()};
    std::int64_t euler = 0;
    for (const isoatlas::ElementId id : isoatlas::ids<isoatlas::ElementId>(answer.elements)) {
        const isoatlas::Element element = analysis.element(id);
        euler += element.l0 - element.h0;
        answer.maxima += element.h0 == 0 ? 1 : 0;
    }
    if (euler != 1) throw std::runtime_error("wrong answer: the Euler numbers of the critical elements sum to " + std::to_string(euler));
    return answer;
}

struct Run {
    double seconds;
    Answer answer;
    PhaseClock::Phases phases;
};

Run run(const isoatlas::Volume& volume, int threads, isoatlas::Interpolant interpolant = isoatlas::Interpolant::faces) {
    PhaseClock phases;
    isoatlas::Context context;
    context.threads = threads;
    context = phases.watched(context);
    const Clock::time_point start = Clock::now();
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant}, context);
    const double seconds = since(start);
    PhaseClock::Phases found = phases.phases();
    return {seconds, answer_of(analysis), std::move(found)};
}

void require_equal(const Answer& answer, const Answer& other) {
    if (!(answer == other)) throw std::runtime_error("wrong answer: two runs of the analysis do not agree");
}

}  // namespace

Timing measure(const isoatlas::Volume& volume, const Options& options, Answer& answer) {
    if (options.pairs > 1) (void)run(volume, options.threads);  // warms up
    const std::int64_t maxima = count_maxima(volume);
    Timing timing;
    const std::set<int> counts{1, options.threads, std::max(options.threads, static_cast<int>(std::thread::hardware_concurrency()))};
    std::vector<double> sorts, ratios, trilinear;
    std::map<int, std::vector<double>> seconds;
    for (int pair = 0; pair < options.pairs; ++pair) {
        if (options.sort) sorts.push_back(seconds_of_sort(volume));
        Run last = run(volume, options.threads);
        if (pair == 0) answer = last.answer;
        if (answer.maxima != maxima) {
            throw std::runtime_error("wrong answer: " + std::to_string(answer.maxima) + " maxima, but there are " + std::to_string(maxima));
        }
        require_equal(answer, last.answer);
        seconds[options.threads].push_back(last.seconds);
        if (options.sort) ratios.push_back(last.seconds / sorts.back());
        timing.phases = std::move(last.phases);
        const Run interior = run(volume, options.threads, isoatlas::Interpolant::trilinear);
        if (interior.answer.maxima != answer.maxima) throw std::runtime_error("wrong answer: the interpolant changes the maxima");
        timing.trilinear_elements = interior.answer.elements;
        trilinear.push_back(interior.seconds / last.seconds);
        for (const int threads : counts) {
            if (threads == options.threads) continue;
            const Run other = run(volume, threads);
            require_equal(answer, other.answer);
            seconds[threads].push_back(other.seconds);
        }
    }
    timing.sort_seconds = median(sorts);
    timing.seconds = median(seconds[options.threads]);
    for (const auto& [threads, values] : seconds) timing.seconds_by_threads[threads] = median(values);
    timing.ratio = median(ratios);
    timing.trilinear_ratio = median(trilinear);
    if (!ratios.empty()) {
        timing.ratio_low = *std::min_element(ratios.begin(), ratios.end());
        timing.ratio_high = *std::max_element(ratios.begin(), ratios.end());
    }
    return timing;
}

}  // namespace bench
