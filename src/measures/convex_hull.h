// The convex hull of points in space or in a plane.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

struct HullFacet {
    std::array<std::int32_t, 3> vertex{};  ///< of ConvexHull::vertices; in the plane an edge: two of them
    Vec3 normal{};                         ///< outwards, unit length
};

struct ConvexHull {
    std::vector<Vec3> vertices;     ///< some of the points
    std::vector<HullFacet> facets;  ///< triangles; empty: the points are flat within rounding, and all of them are vertices
};

/// rank 2: the points lie in the plane z = 0. Points within about 1e-14 of the size of the hull from its boundary may be missing among the
/// vertices. Cost: O(n log n) for the points of surfaces. By Qhull (Barber, Dobkin, Huhdanpaa: The Quickhull algorithm for convex hulls,
/// ACM Transactions on Mathematical Software 22, 1996). Thread safe.
[[nodiscard]] ConvexHull convex_hull(std::span<const Vec3> points, int rank);

/// Those of the points that may be vertices of the hull of these and other points. Cost: as above.
[[nodiscard]] std::vector<Vec3> hull_points(std::span<const Vec3> points, int rank);

}  // namespace isoatlas
