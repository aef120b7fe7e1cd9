// The first homology of the Highs over all cuts, by plain reduction of the boundary matrix of a whole cell complex. Faces alone: no bodies.
#pragma once

#include <vector>

#include "oracle/oracle.h"

namespace oracle {

/// A hole is there for tau in (closes, opens]; opens > closes.
struct HolePair {
    double opens, closes;
    auto operator<=>(const HolePair&) const = default;
};

/// The complex: elements; edges of the grid and from face points to their corners; faces, an ambiguous one as four triangles; and in every
/// cell a disk for every loop on its border, because the Highs of a cell are balls
/// (docs/theory/1-elements-and-order.md#objects-low-components-contours). A cell of the complex is there when all its elements are High.
/// Ascending. Cost: cubic in the elements.
std::vector<HolePair> hole_pairs(const Elements& elements);

}  // namespace oracle
