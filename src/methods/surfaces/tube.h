// A tube between two loops of a cell: triangles with their corners at the hits of both, where the inside of the cell joins what they part.
//
// As a strip between two polygons (tiling.h), the one of the smallest area. The tables of Marching Cubes 33 do the same, but for
// case 6.1.2, with points on edges alone. Then some tubes have triangles that lie in an ambiguous face: the neighbour may have the same
// ones there, and edges with four triangles. And triangles of some tubes cross.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

using HitTriangle = std::array<std::uint8_t, 3>;  ///< edges of a cell

/// one, other: the edges of two loops in turn, as in field/cell_loops.h. at: the hit of each edge. Triangles are turned as those of a disk
/// in each loop. O(edges^4): tubes are rare.
[[nodiscard]] std::vector<HitTriangle> tube(std::span<const std::uint8_t> one, std::span<const std::uint8_t> other,
                                            const std::array<Vec3, 12>& at);

}  // namespace isoatlas
