// The second phase of a build: the voxels of every element, and the tables and sums that follow from the zones.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "features/zone_sums.h"
#include "store/pack.h"

namespace isoatlas {

class Analysis;
struct Context;
struct VolumeView;

struct ZonePhase {
    std::vector<PackedArray> arrays;
    ZoneSums sums;  ///< referenced by the arrays
};

/// analysis: critical elements and arcs; it has zones and trees afterwards, and must live until the arrays are packed. counting: progress
/// of counting. done: progress of ranking, 0 to 1. Cost: count_voxels(); and of at most kTableElements elements complete() and rank_both().
[[nodiscard]] std::unique_ptr<ZonePhase> zone_phase(Analysis& analysis, const VolumeView& volume, const Context& context,
                                                    const Context& counting, const std::function<void(double)>& done);

/// Only the tables, events and sums, of an analysis with zones; empty for more than kTableElements elements.
[[nodiscard]] std::unique_ptr<ZonePhase> zone_tables(const Analysis& analysis, const VolumeView& volume, const Context& context);

}  // namespace isoatlas
