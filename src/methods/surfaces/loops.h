// Methods that make polygons of a cell: their corners are the hits of its edges, linked across its faces, cut into triangles as fans.
//
// Where the corners of a face alternate, two pairs of links are possible. Marching Cubes (section 3.2; Lorensen, Cline, 1987) has 15 cases
// up to rotation and complement: a cell with at most four Highs separates them, one with more separates its Lows. The cell on the other
// side of the face may decide otherwise; then there is a hole. The asymptotic decider (Nielson, Hamann, 1991) joins the Highs of such a
// face where the saddle of the bilinear interpolant is High: both cells agree.
#pragma once

#include <bit>

#include "field/cell_loops.h"
#include "field/face.h"
#include "methods/surfaces/edge_points.h"

namespace isoatlas {

enum class FaceRule : std::uint8_t { fewer_are_separate, asymptotic_decider };

/// Faces of a cell whose Highs are joined across them, a bit each; of those that alternate.
template <class T>
int joined_faces(const Index3& cell, int pattern, FaceRule rule, const EdgePoints<T>& points) {
    if (rule == FaceRule::fewer_are_separate) return std::popcount(static_cast<unsigned>(pattern)) > 4 ? 63 : 0;
    int joined = 0;
    for (int face = 0; face < 6; ++face) {
        if (!face_is_split(pattern, face)) continue;
        std::array<double, 4> at;
        for (std::size_t i = 0; i < 4; ++i) at[i] = points.value(corner_of(cell, kFaceCorners[face][i]));
        const Diagonal highs = at[0] >= points.tau() ? Diagonal::ac : Diagonal::bd;
        joined |= static_cast<int>(highs_are_joined(at[0], at[1], at[2], at[3], highs, points.tau())) << face;
    }
    return joined;
}

[[nodiscard]] inline std::span<const std::uint8_t> edges_of(const CellLoops& loops, int loop) {
    return std::span(loops.edge).subspan(loops.begin[static_cast<std::size_t>(loop)], static_cast<std::size_t>(loops.size(loop)));
}

/// The point on an edge of a cell.
template <class T>
std::int64_t hit_of(const Index3& cell, int pattern, std::size_t edge, EdgePoints<T>& points) {
    const auto [from, to] = kEdgeCorners[edge];
    const bool is_first_high = (pattern >> from & 1) != 0;
    return points.point(corner_of(cell, is_first_high ? from : to), corner_of(cell, is_first_high ? to : from));
}

/// Adds the triangles of an active cell.
template <class T>
void add_loops(const Index3& cell, FaceRule rule, EdgePoints<T>& points) {
    const int pattern = points.pattern(cell);
    const CellLoops& loops = cell_loops(pattern, joined_faces(cell, pattern, rule, points));
    for (int loop = 0; loop < loops.count; ++loop) {
        const std::span<const std::uint8_t> edges = edges_of(loops, loop);
        const auto hit = [&](std::size_t i) { return hit_of(cell, pattern, edges[i], points); };
        const std::int64_t first = hit(0);
        for (std::size_t i = 1; i + 1 < edges.size(); ++i) points.add_triangle(first, hit(i), hit(i + 1));
    }
}

}  // namespace isoatlas
