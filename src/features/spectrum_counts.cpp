#include <algorithm>
#include <limits>

#include "isoatlas/spectrum.h"

namespace isoatlas {

SpectrumInterval counts_at(const Spectrum& spectrum, double tau) {
    const auto above = std::ranges::partition_point(spectrum.intervals, [tau](const SpectrumInterval& i) { return i.low >= tau; });
    if (above != spectrum.intervals.end() && tau <= above->high) return *above;
    return {spectrum.intervals.empty() ? tau : spectrum.intervals.front().high, std::numeric_limits<double>::infinity(), {}, {}};
}

}  // namespace isoatlas
