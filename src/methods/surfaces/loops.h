// Methods that make polygons of a cell: their corners are the hits of its edges, linked across its faces, cut into triangles as fans.
//
// Where the corners of a face alternate, two pairs of links are possible. Marching Cubes (section 3.2; Lorensen, Cline, 1987) has 15 cases
// up to rotation and complement: a cell with at most four Highs separates them, one with more separates its Lows. The cell on the other
// side of the face may decide otherwise; then there is a hole. The asymptotic decider (Nielson, Hamann, 1991) joins the Highs of such a
// face where the saddle of the bilinear interpolant is High: both cells agree.
#pragma once

#include <bit>

#include "field/cell_loops.h"
#include "methods/surfaces/edge_points.h"

namespace isoatlas {

enum class FaceRule : std::uint8_t { fewer_are_separate, asymptotic_decider };

/// Adds the triangles of an active cell.
template <class T>
void add_loops(const Index3& cell, FaceRule rule, EdgePoints<T>& points) {
    const int pattern = points.pattern(cell);
    int joined = rule == FaceRule::fewer_are_separate && std::popcount(static_cast<unsigned>(pattern)) > 4 ? 63 : 0;
    for (int face = 0; face < 6 && rule == FaceRule::asymptotic_decider; ++face) {
        if (!face_is_split(pattern, face)) continue;
        std::array<double, 4> at;
        for (std::size_t i = 0; i < 4; ++i) at[i] = points.value(corner_of(cell, kFaceCorners[face][i]));
        const double saddle = (at[0] * at[2] - at[1] * at[3]) / (at[0] + at[2] - at[1] - at[3]);
        joined |= static_cast<int>(saddle >= points.tau()) << face;
    }
    const CellLoops& loops = cell_loops(pattern, joined);
    for (int loop = 0; loop < loops.count; ++loop) {
        const auto hit = [&](int i) {
            const auto [from, to] = kEdgeCorners[loops.edge[loops.begin[loop] + i]];
            const bool is_first_high = (pattern >> from & 1) != 0;
            return points.point(corner_of(cell, is_first_high ? from : to), corner_of(cell, is_first_high ? to : from));
        };
        const std::int64_t first = hit(0);
        for (int i = 1; i + 1 < loops.size(loop); ++i) points.add_triangle(first, hit(i), hit(i + 1));
    }
}

}  // namespace isoatlas
