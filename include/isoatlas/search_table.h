// Search table: how many cells are loaded and visited to find the active ones. Table 13.1 of the dissertation, for any volume.
//
// Isovalues: one in the middle of every interval between neighbouring values among the critical values (of events) and the lowest sample;
// in such an interval the zones do not change. All have the same weight in averages.
// Cells: boxes between 8 neighbouring samples (4 in 2D), (nx-1)(ny-1)(nz-1) of them; caps where a surface meets the end of the volume
// belong to none. A cell is *active* at tau when its lowest sample < tau <= its highest.
// Two ways to find the active cells:
//   zone files  the dissertation's (sections 10.1 and 11.2). A zone is *active* at tau when tau lies in (value of its parent, its value].
//               The points of its file are its voxels, and those adjacent to its object (grid edges) when it ends, which wait to be
//               flooded. Cells with such a point at a corner are in the file, sorted by their highest sample. *Loaded*: the cells in the
//               files of all active zones. *Visited*: in each file those from the highest down to the first whose highest sample is below
//               tau, included.
//   bricks      ours (docs/decisions/0009). A brick of 16 x 8 x 8 samples is read when tau divides it, or what a surface would read
//               around it; outside the volume everything is Low. Loaded and visited: the cells whose first corner lies in a brick that is
//               read.
// Load utility: active / loaded; travel utility: active / visited, in percent.
// Where the dissertation keeps a file for each component of a zone, a zone has one file here: all its components are active together, and a
// cell in two of them counts once. A voxel waits in the files of all objects that it is adjacent to, not of the first one alone; otherwise
// cells would be missed where objects meet.
#pragma once

#include <cstdint>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Cost of one isovalue, in cells.
struct SearchCost {
    double tau;
    std::int64_t active;
    std::int64_t zones_loaded, zones_visited;  ///< a cell in the files of several active zones counts in each
    std::int64_t bricks_loaded;
    std::int64_t bricks_read;  ///< bricks, not cells
};

/// Over all isovalues (zone points: over all zones). Nothing to count: all 0.
struct Spread {
    double max = 0, average = 0, min = 0;
};

struct SearchWay {
    Spread visited, loaded;
    Spread load_utility, travel_utility, loaded_percent;  ///< percent; the last: of all cells
};

struct SearchTable {
    std::int64_t cells = 0, zones = 0, isovalues = 0;
    Spread zone_points;  ///< in the file of a zone
    Spread active, active_percent;
    SearchWay zone_files, bricks;
};

/// Per isovalue, ascending. analysis: of this volume, with zones. Throws Error{usage} without zones, cancelled.
/// Cost: O(cells log events) time whatever the number of isovalues; O(slab + events) memory.
[[nodiscard]] std::vector<SearchCost> search_costs(const Volume& volume, const Analysis& analysis, const Context& context = {});

/// The same summed up. Cost: that of search_costs.
[[nodiscard]] SearchTable search_table(const Volume& volume, const Analysis& analysis, const Context& context = {});

}  // namespace isoatlas
