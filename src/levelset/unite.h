// Union-find over runs: which runs belong together at tau.
#pragma once

#include "base/union_find.h"
#include "field/sample_grid.h"
#include "levelset/runs.h"

namespace isoatlas {

using RunSets = UnionFind<std::int64_t>;  ///< by the numbers of RunIds

/// Sets of connected runs; the root of a set is its first run in scan order. Highs and Lows never share a set; runs of Lows at the border
/// of the volume are not yet joined to each other, and what touches padding is joined to the first run of its own row.
[[nodiscard]] RunSets unite_runs(const SampleView& volume, double tau, double tunnel_height, const HighBits& high, const Runs& runs,
                                 const Context& context);

}  // namespace isoatlas
