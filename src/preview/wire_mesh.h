// Compact encoding of a surface for a viewer: positions quantised to a fraction of a voxel, normals in two bytes, triangles in an order
// that compresses well.
//
//   0   "iam1"
//   4   points, triangles, bytes of the packed points, bytes of the packed triangles: uint32 each
//   20  zero: uint32
//   24  origin x, y, z, step: float64 each; a point is origin + step * its three numbers, in physical coordinates
//   56  the points, encoded by meshoptimizer's vertex codec (version 0): 8 bytes each: x, y, z as uint16, normal as two int8
//       then the triangles, encoded by its index codec (version 1): three uint32 each
//
// Everything is little endian. Two bytes of a normal are an octahedral map of the unit sphere, 127 = 1.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "isoatlas/context.h"
#include "isoatlas/surface.h"
#include "isoatlas/surface_methods.h"

namespace isoatlas {

struct WireOptions {
    double step = 0;        ///< of positions, physical; larger where 65536 steps do not span the surface. Positive
    bool strips = true;     ///< triangles in strips: a seventh fewer bytes, most of the time
    bool distinct = false;  ///< points keep places of their own and triangles an area (distinct_places.h), for files without indices
};

struct WireMesh {
    std::string bytes;
    std::int64_t points = 0, triangles = 0;
    bool coarse = false;               ///< not of the exact surface; the caller sets it, and what follows
    double spacing = 0;                ///< SurfaceSample::spacing of points alone; 0: a surface
    std::optional<double> distance{};  ///< of a level of detail from the exact surface, at most, in voxels
    std::optional<double> pixels{};    ///< the same as it is seen, in pixels
    std::size_t without_area = 0;      ///< WireOptions::distinct: triangles without area nevertheless
};

/// surface: of a 3D volume, with normals. Throws Error: resource (more than 2^31 points or 2^30 triangles), cancelled.
/// Cost: about 300 ns a triangle, 100 ns without strips; 60 bytes of memory.
[[nodiscard]] WireMesh wire_mesh(const Surface& surface, const WireOptions& options, const Context& context = {});

/// Points alone, without triangles. Throws Error{resource} for more than 2^31. Cost: about 100 ns a point.
[[nodiscard]] WireMesh wire_points(const PointCloud& cloud, double step, const Context& context = {});

}  // namespace isoatlas
