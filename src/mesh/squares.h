// 2D: the level curves of an image as closed, oriented polylines.
// In the literature: marching squares, with the asymptotic decider (Nielson, Hamann 1991).
#pragma once

#include "field/grid.h"
#include "mesh/layout.h"

namespace isoatlas {

/// Number of segments in the square row y.
[[nodiscard]] std::int64_t count_segments(const MeshDomain& domain, std::int64_t y);

/// Writes the segments of square row y at its offset. The Highs lie to the left; flip: the geometry is mirrored.
template <class T>
void write_segments(const SampleGrid<T>& grid, double tau, const MeshDomain& domain, std::int64_t y, const Layout& layout, bool flip,
                    Surface& surface);

}  // namespace isoatlas
