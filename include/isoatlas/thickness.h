// How thick the walls of a solid are. Definition with sources: docs/measures.md#wall-thickness.
#pragma once

#include <cstdint>

#include "isoatlas/context.h"
#include "isoatlas/surface.h"

namespace isoatlas {

struct WallOptions {
    double limit = 0;  ///< which walls WallThickness::thin_area counts; unit of the points
};

/// Lengths in the unit of the points.
struct WallThickness {
    double min = 0;              ///< of the thinnest wall
    double median = 0;           ///< by area: half of the surface of walls has less behind it
    double area = 0;             ///< of the surface that belongs to walls: has surface of the same solid opposite to it
    double thin_area = 0;        ///< of what is thinner than WallOptions::limit
    std::int64_t triangles = 0;  ///< of walls; 0: nothing of the surface belongs to one
};

/// surface: closed triangles. The same numbers for any number of threads. Throws Error: usage (curves, an open surface), unsupported (2^32
/// points), resource (memory), cancelled. Cost: seven rays a point; memory: about 200 bytes a triangle.
[[nodiscard]] WallThickness wall_thickness(const Surface& surface, const WallOptions& options = {}, const Context& context = {});

}  // namespace isoatlas
