// Fewer triangles with the same topology: edge collapses in the order of their quadric error, each only where the link condition holds.
#pragma once

#include <cstddef>

#include "isoatlas/context.h"
#include "isoatlas/surface.h"

namespace isoatlas {

/// Reduces a closed surface of a 3D volume towards `max` triangles; unchanged if it has no more. Points are a subset of those before, with
/// their normals. Every component keeps its Euler number (Dey, Edelsbrunner, Guha, Nekhayev: Topology preserving edge contraction, 1999):
/// a surface with many tunnels ends above `max`. Edges with a number of triangles other than two are kept. Triangles may intersect.
/// Ids of points are left out. Fewer than 2^30 triangles. Throws Error: cancelled. The same result for any number of threads. Cost: about
/// 2 us and 150 bytes a triangle.
[[nodiscard]] Surface collapse_edges(const Surface& surface, std::size_t max, const Context& context = {});

/// The guarantee of collapse_edges(), decided on indices: the same components with the same Euler numbers, in any order; manifold as
/// before.
[[nodiscard]] bool has_same_topology(const Surface& before, const Surface& after);

}  // namespace isoatlas
