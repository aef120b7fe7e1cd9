// Points spread over a surface: a picture of it where it has too many triangles to be drawn.
#pragma once

#include <cstdint>

#include "isoatlas/context.h"
#include "isoatlas/surface.h"
#include "isoatlas/surface_methods.h"

namespace isoatlas {

struct SurfaceSample {
    PointCloud cloud{};
    double spacing = 0;  ///< physical: the surface has so much area for each point, squared
};

/// So many points of a surface with normals, by systematic sampling: one for each equal part of its area, in the order of its triangles;
/// inside a triangle by the R2 sequence (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018). None of a surface without
/// area. The same for any number of threads, and for any machine that rounds alike. Cost: about 15 ns a triangle, 50 ns a point, on all
/// threads; 8 bytes a triangle.
[[nodiscard]] SurfaceSample sample_surface(const Surface& surface, std::int64_t points, const Context& context = {});

}  // namespace isoatlas
