// The points of a surface, for a viewer that draws triangles.
#pragma once

#include <cstdint>

#include "isoatlas/context.h"
#include "isoatlas/surface.h"

namespace isoatlas {

class Atlas;

struct PointLimits {
    int divisions = 1;  ///< of a cell along each axis
    std::int64_t triangles = 0, bytes = 0;
};

/// The points of Dividing Cubes of a surface of the store, as squares. Throws Error: resource (more than the limits), as Atlas::samples().
[[nodiscard]] Surface points_as_squares(const Atlas& atlas, const Surface& surface, const PointLimits& limits, const Context& context);

}  // namespace isoatlas
