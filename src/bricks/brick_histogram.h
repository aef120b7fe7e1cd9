// Histogram of the samples of a store: bricks with their range inside one bin are counted without reading them.
#pragma once

#include <span>
#include <vector>

#include "store/brick_reader.h"

namespace isoatlas {

/// Counts of the samples in [edges[i], edges[i + 1]); the last one has its end too. edges: ascending, two at least; samples beyond them are
/// not counted. Cost: reads the bricks with samples on both sides of an edge.
template <class T>
[[nodiscard]] std::vector<std::int64_t> brick_histogram(const BrickReader<T>& bricks, std::span<const double> edges, const Context& context,
                                                        IoCounters& counters);

}  // namespace isoatlas
