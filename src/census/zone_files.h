// The zone files of the dissertation (section 10.1), counted without being written.
//
// The file of a zone has its points: the voxels of the zone, and the voxels around its object that wait to be flooded when the zone ends.
// Its cells are those with such a point at a corner, sorted by their highest sample. A voxel q waits from the zone of a neighbour above it
// to its own, so it lies in the files of a chain of events, a cell in those of a few chains, and all counts are sums over chains.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/phase.h"
#include "isoatlas/analysis.h"

namespace isoatlas {

/// Of search_costs().
inline constexpr PhasePlan<2> kSearchPhases{{"active cells", "zone files"}};

struct ZoneFiles {
    std::vector<std::int64_t> points;   ///< per event: of its file
    std::vector<std::int64_t> loaded;   ///< per isovalue: cells in the files of the active zones
    std::vector<std::int64_t> visited;  ///< per isovalue: visited cells: from the highest down to the first below the isovalue
};

/// analysis: of the volume, with zones. isovalues: ascending. Cost: O(cells log events) time, O(slab + events + isovalues) memory.
[[nodiscard]] ZoneFiles count_zone_files(const Volume& volume, const Analysis& analysis, std::span<const double> isovalues,
                                         const Context& context);

}  // namespace isoatlas
