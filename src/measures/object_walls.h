// How thick the walls of each object are (docs/measures.md#wall-thickness).
#pragma once

#include <span>

#include "isoatlas/context.h"
#include "isoatlas/measures.h"

namespace isoatlas {

/// Sets the thickness of measures of which id is known; the surface: closed triangles with ids, of these objects and no others. Cost: that
/// of wall_thickness().
void measure_walls(const Surface& surface, std::span<ObjectMeasures> objects, const Context& context);

}  // namespace isoatlas
