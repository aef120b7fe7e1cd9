// A spectrum in a bounded number of columns: neighbouring intervals together, with the range of each count.
#pragma once

#include <cstdint>
#include <vector>

#include "isoatlas/spectrum.h"

namespace isoatlas {

/// The lowest and the highest of each count, each by itself.
struct CountRange {
    LevelCounts min, max;
};

/// The isovalues (low, high] of neighbouring intervals.
struct SpectrumColumn {
    double low, high;        ///< stored values
    std::int64_t intervals;  ///< so many; of 1 the ranges are single counts
    CountRange all, significant;
};

/// At most max_columns (0: any number) that cover the intervals in their order. More intervals than that are shared out half by their
/// number and half by their isovalues: no column has more than 2 / max_columns of the intervals, nor (but for a single interval) of the
/// range.
[[nodiscard]] std::vector<SpectrumColumn> spectrum_columns(const Spectrum& spectrum, std::int64_t max_columns);

}  // namespace isoatlas
