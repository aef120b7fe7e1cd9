// The second phase of a build: the voxels of every element, and the tables and sums that follow from the zones.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/contour_arcs.h"
#include "features/zone_sums.h"
#include "store/pack.h"

namespace isoatlas {

struct ZonePhase {
    std::vector<PackedArray> arrays;
    // referenced by the arrays:
    ElementVoxels voxels;
    std::optional<Analysis> analysis{};
    ZoneSums sums;
};

/// counting: progress of counting. done: progress of ranking, 0 to 1. Cost: count_voxels(); and of at most kTableElements elements
/// make_analysis() and rank_both().
[[nodiscard]] std::unique_ptr<ZonePhase> zone_phase(ContourArcs arcs, const VolumeView& volume, const Context& context,
                                                    const Context& counting, const std::function<void(double)>& done);

/// Only the tables, events and sums, of an analysis with zones; empty for more than kTableElements elements.
[[nodiscard]] std::unique_ptr<ZonePhase> zone_tables(const Analysis& analysis, const VolumeView& volume, const Context& context);

}  // namespace isoatlas
