// How large is a surface?
#pragma once

#include "isoatlas/context.h"
#include "isoatlas/surface.h"

namespace isoatlas {

/// Physical area of the surface, and the volume that it encloses (2D: length, area). Sums have the same order for any threads.
struct SurfaceSize {
    double area = 0, measure = 0;
};

/// Of a closed surface: normals point outwards. Cost: O(triangles).
[[nodiscard]] SurfaceSize size_of_surface(const Surface& surface, const Context& context);

}  // namespace isoatlas
