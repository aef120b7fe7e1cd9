// Feret diameters of a convex hull.
#pragma once

#include "isoatlas/measures.h"
#include "measures/convex_hull.h"

namespace isoatlas {

/// docs/measures.md#feret-diameters. Cost: the maximum O(vertices^2) comparisons at most; the minimum about O(facets).
[[nodiscard]] FeretDiameters feret_diameters(const ConvexHull& hull, int rank);

}  // namespace isoatlas
