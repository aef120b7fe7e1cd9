// How far two triangle meshes are from each other, in both directions, with proven bounds: not only at points.
//
// In the literature: Hausdorff distance; METRO (Cignoni, Rocchini, Scopigno, Computer Graphics Forum 17, 1998) samples it, here it is
// enclosed by branch and bound: a triangle is halved until the distance from every point of it is known closely enough. Known are the
// distances at its corners; that from one triangle is greatest at a corner of another, because it is convex; that from a mesh changes at
// most as a point moves.
#pragma once

#include <cstdint>
#include <span>

#include "geometry/triangle_tree.h"
#include "isoatlas/context.h"

namespace isoatlas {

/// The greatest distance of a point of one mesh from the other mesh.
struct OneSidedDistance {
    double lower = 0, upper = 0;  ///< it lies between these, up to rounding of 1e-12 of the coordinates; infinite: the other mesh is empty
    Vec3 place{};                 ///< a point of the one mesh that is so far from the other as `lower` says
    std::int64_t triangle = -1;   ///< of the one mesh, there; -1: it is empty
};

struct Deviation {
    OneSidedDistance first_to_second, second_to_first;
    [[nodiscard]] double lower() const { return std::max(first_to_second.lower, second_to_first.lower); }
    [[nodiscard]] double upper() const { return std::max(first_to_second.upper, second_to_first.upper); }
};

struct MeshView {
    std::span<const Vec3> points;
    std::span<const TriangleCorners> triangles;
};

struct DeviationOptions {
    double tolerance = 1e-3;  ///< upper - lower is at most this, in the unit of the points. Above 0
    double limit = 0;         ///< above 0: more closely, down to 1e-6 of it, where that may decide whether the distance is at most this
};

/// Finite coordinates, in the metric that distances are wanted in. The same for any number of threads. Throws Error: usage (tolerance),
/// cancelled. Cost: some 10 microseconds a triangle of both meshes. Memory: 40 bytes a triangle of the larger mesh.
[[nodiscard]] Deviation measure_deviation(const MeshView& first, const MeshView& second, const DeviationOptions& options = {},
                                          const Context& context = {});

}  // namespace isoatlas
