// The files of zones as the dissertation says (section 10.1): which voxels are points of the file of a zone, which cells lie in it.
#pragma once

#include <set>
#include <vector>

#include "isoatlas/analysis.h"
#include "oracle/oracle.h"

namespace oracle {

/// Corners of all cells, in the order of their numbers.
inline std::vector<std::vector<Index>> cells_of(const Grid& grid) {
    std::vector<std::vector<Index>> cells;
    const Index deep = grid.rank == 2 ? 1 : grid.size[2] - 1;
    for (Index z = 0; z < deep; ++z) {
        for (Index y = 0; y + 1 < grid.size[1]; ++y) {
            for (Index x = 0; x + 1 < grid.size[0]; ++x) {
                std::vector<Index> corners;
                for (Index k = 0; k < (grid.rank == 2 ? 4 : 8); ++k)
                    corners.push_back(grid.index(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2)));
                cells.push_back(corners);
            }
        }
    }
    return cells;
}

/// Is one event the other, or above it in the tree?
inline bool becomes(const isoatlas::Analysis& analysis, isoatlas::EventId from, isoatlas::EventId to) {
    while (from.exists() && from != to) from = analysis.event(from).parent;
    return from == to;
}

/// Voxels of the zone, and those beside its object when it ends, which wait to be flooded. analysis: of the grid, with zones.
inline std::set<Index> zone_points(const Grid& grid, const isoatlas::Analysis& analysis, isoatlas::EventId event) {
    std::vector<bool> inside(static_cast<std::size_t>(grid.voxels()));  // the object when its zone ends
    for (Index v = 0; v < grid.voxels(); ++v) inside[v] = becomes(analysis, analysis.zone(isoatlas::VoxelId(v)), event);
    std::set<Index> points;
    for (Index v = 0; v < grid.voxels(); ++v) {
        if (analysis.zone(isoatlas::VoxelId(v)) == event) points.insert(v);
        for (int d = 0; d < grid.directions(); ++d) {
            const Index other = grid.neighbour(v, d);
            if (!inside[v] && other >= 0 && inside[other]) points.insert(v);
        }
    }
    return points;
}

}  // namespace oracle
