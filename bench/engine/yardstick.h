// The yardstick: one single-threaded std::sort of the volume's (value, index) pairs. And counts made without the engine.
#pragma once

#include <isoatlas/volume.h>

#include <cstdint>

namespace bench {

/// Seconds of std::sort alone (the pairs, value and 32-bit index, are filled in before the clock starts).
[[nodiscard]] double seconds_of_sort(const isoatlas::Volume& volume);

/// Voxels above all their 6 neighbours, ties broken by index: the maxima, counted by comparing and nothing else.
[[nodiscard]] std::int64_t count_maxima(const isoatlas::Volume& volume);

}  // namespace bench
