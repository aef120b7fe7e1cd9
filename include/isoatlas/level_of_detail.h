// Level of detail: the same surface with fewer triangles, its topology kept exactly and its distance bounded.
#pragma once

#include <cstdint>

#include "isoatlas/context.h"
#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// The unit of SimplificationOptions::max_distance. voxel: distances are measured between samples one apart along every axis, whatever
/// their spacing; of a rectilinear grid, the smallest step of each axis. physical: Geometry::unit.
enum class DistanceUnit : std::uint8_t { voxel, physical };

struct SimplificationOptions {
    double max_distance = 0.5;  ///< between the surfaces, both ways; infinity: no bound
    DistanceUnit unit = DistanceUnit::voxel;
    std::int64_t triangles = 0;  ///< not fewer than this
};

/// Fewer triangles by edge collapses, cheapest first (quadric error: Garland and Heckbert, Surface simplification using quadric error
/// metrics, 1997), each only where
/// (a) the link condition holds (Dey, Edelsbrunner, Guha, Nekhayev: Topology preserving edge contraction, 1999): every contour keeps its
///     genus, none joins another;
/// (b) every point of `surface`, also inside its triangles, stays within max_distance of the result, and every point of the result within
///     max_distance of `surface`;
/// (c) no triangle meets another but in common points, and no point lies in the space that is swept: contours stay nested as they are;
/// (d) points of caps and rims stay in the faces of the volume where they are.
/// docs/theory/10-level-of-detail.md has the proofs. Normals are those of the surface at the nearest place, ids those of the points.
/// `geometry` and `extent` are those of the volume. Curves (2D) are returned as they are. Throws Error: usage (max_distance not positive,
/// a negative number of triangles, axes that do not span space), resource (2^30 triangles or more), cancelled. The same bytes for any
/// number of threads. Cost: some 30 us and 550 bytes a triangle.
[[nodiscard]] SimplifiedSurface simplify_surface(const Surface& surface, const Geometry& geometry, const Extent& extent,
                                                 const SimplificationOptions& options = {}, const Context& context = {});

}  // namespace isoatlas
