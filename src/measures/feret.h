// Feret diameters of a convex hull.
#pragma once

#include "isoatlas/measures.h"
#include "measures/convex_hull.h"

namespace isoatlas {

/// docs/measures.md#feret-diameters. Cost: about O(facets); in the plane, and of flat points, O(vertices^2).
[[nodiscard]] FeretDiameters feret_diameters(const ConvexHull& hull, int rank);

}  // namespace isoatlas
