// Some of the points of a surface on edges of the grid, spread evenly over it: a picture of it before it has triangles.
#pragma once

#include <cstdint>

#include "base/big_vector.h"
#include "base/id_array.h"
#include "isoatlas/context.h"
#include "isoatlas/surface.h"
#include "levelset/components.h"

namespace isoatlas {

/// The area of a surface by its hits: a unit of area with the normal n is crossed by sum |n . e| / V edges of the grid, e the steps along
/// its axes and V the volume of a cell, so that a hit stands for the inverse of it. On uneven axes steps are those of Geometry::spacing.
/// Of every point, physical; 0 of those whose contour is not chosen. chosen: empty: all; otherwise Surface::contour holds contour numbers.
/// Cost: about 3 ns a point, on all threads.
/// In the literature: the formula of Cauchy and Crofton for three directions (Santalo, Integral geometry and geometric probability, 1976).
[[nodiscard]] BigVector<float> areas_of_hits(IdSpan<ContourNumber, const std::uint8_t> chosen, const Geometry& geometry,
                                             const Context& context, const Surface& surface);

/// Leaves a surface of hits alone, in their order, about so many of its points: one for each equal part of the area. A point that stands
/// for several parts, of a surface with few hits, comes several times. Returns the area of a part; 0: of nothing.
/// The same for any number of threads. Cost: about 2 ns a point, on all threads.
double thin_points(const BigVector<float>& areas, std::int64_t wanted, const Context& context, Surface& surface);

}  // namespace isoatlas
