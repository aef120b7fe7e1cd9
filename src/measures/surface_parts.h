// What the surface of each object says about it: volume, area, tunnels, cavities, extent.
#pragma once

#include <cstdint>
#include <span>

#include "isoatlas/context.h"
#include "isoatlas/measures.h"

namespace isoatlas {

/// Completes measures of which id and axes are known; the surface: closed, with ids, of these objects and no others. Sums of fixed blocks
/// of triangles in their order. Throws Error{cancelled}. Cost: O(surface) time; memory: two numbers for each point and triangle.
void measure_surface(const Surface& surface, const VolumeInfo& info, std::span<ObjectMeasures> objects, const Context& context);

}  // namespace isoatlas
