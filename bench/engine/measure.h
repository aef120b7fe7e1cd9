// Times and checks of one volume: the engine against the sort, in turns.
#pragma once

#include <isoatlas/isoatlas.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace bench {

struct Timing {
    double sort_seconds = 0;                   ///< median; 0 when the sort was not asked for
    double seconds = 0;                        ///< median of analyse on `threads` threads
    std::map<int, double> seconds_by_threads;  ///< median of analyse on one thread, on `threads` and on all processors
    double ratio = 0;                          ///< median over the pairs of analyse / sort
    double ratio_low = 0, ratio_high = 0;
    double trilinear_ratio = 0;  ///< median over the pairs of analyse with the trilinear interpolant / with faces only
    std::int64_t trilinear_elements = 0;
    std::vector<std::pair<std::string, double>> phases;  ///< seconds by phase of the last parallel run, as the engine reports them
};

struct Answer {
    std::int64_t elements, maxima, events, arcs;
    bool operator==(const Answer&) const = default;
};

struct Options {
    int threads = 2;
    int pairs = 3;
    bool sort = true;
};

/// Runs sort, analyse, sort, analyse, ... and gives medians. Throws std::runtime_error when an answer is wrong: the sum of l0 - h0 over the
/// critical elements is not 1, the number of maxima is not the counted one, or one thread and several do not agree.
[[nodiscard]] Timing measure(const isoatlas::Volume& volume, const Options& options, Answer& answer);

}  // namespace bench
