// A surface without the contours that nobody has chosen.
#pragma once

#include "base/id_array.h"
#include "isoatlas/context.h"
#include "isoatlas/surface.h"
#include "levelset/components.h"

namespace isoatlas {

/// Keeps the points of the chosen contours and what is between them, in their order. Surface::contour holds contour numbers.
/// Cost: O(points + triangles) on all threads; 8 bytes a point and one array at a time a second time; no memory where all is chosen.
void keep_contours(IdSpan<ContourNumber, const std::uint8_t> chosen, const Context& context, Surface& surface);

}  // namespace isoatlas
