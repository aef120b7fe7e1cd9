// Paths on the border of one cell between its Highs.
#pragma once

#include <vector>

#include "critical/faces.h"

namespace isoatlas {

/// Elements of the cell (corners 0..7, the point of ambiguous face g is 8 + g) from one corner to another, all of them above the point of
/// face f, each a neighbour of the one before; a shortest path. Empty: there is none.
[[nodiscard]] std::vector<int> path_above_face(const CellElements& cell, int f, int from, int to);

}  // namespace isoatlas
