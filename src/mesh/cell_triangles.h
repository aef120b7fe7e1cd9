// The triangles of one cell, for every case of field/cell_loops.h and both styles.
//
// full: a loop of n hits is a fan of n triangles around its articulation point (docs/theory/5-surfaces.md#spider-web).
// compact: where that stays embedded, a loop is a fan of n - 2 triangles around one of its own hits. This needs
//   - no chord between two hits of one face of the cell: the neighbour could use the same chord, and the mesh would not be a manifold;
//   - no other loop of more than 3 hits in the cell.
// Why it is embedded: two triangles (v, a, b), (v, c, d) that met outside v would meet on ab or cd, say in q on ab. ab lies in a face F of
// the cell, a convex body, so q lies in the hull of those of v, c, d that lie in F. The hits in F other than a, b are at most the ends
// of one other link, which is disjoint from ab; the hull could be more only if a chord joined two hits of F. A loop of 3 hits cuts off a
// corner by a plane that has all other hits on its far side.
//
// In the literature: polygons of the cases of Marching Cubes (Lorensen, Cline 1987), with a point inside them (Lopes, Brodlie, Improving
// the robustness and accuracy of the marching cubes algorithm, 2003).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "field/cell_loops.h"
#include "isoatlas/surface.h"

namespace isoatlas {

/// Triangles of one case. A corner is an edge number 0..11 (the hit there), or 12 + i: articulation point i of the cell.
struct CellTriangles {
    std::uint8_t triangles = 0;
    std::uint8_t articulation_points = 0;             ///< number of articulation points
    std::array<std::uint8_t, 4> articulation_loop{};  ///< the loop of articulation point i
    std::array<std::uint8_t, 36> corner{};            ///< 3 per triangle, counter-clockwise seen from the Lows
};

/// One entry per case. Made once for each style.
const std::vector<CellTriangles>& cell_triangles(SurfaceStyle style);

/// Do two edges of a cell lie on one of its faces?
[[nodiscard]] bool edges_share_face(int edge, int other);

}  // namespace isoatlas
