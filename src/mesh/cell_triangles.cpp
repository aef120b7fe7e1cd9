#include "mesh/cell_triangles.h"

#include "base/check.h"

namespace isoatlas {
namespace {

bool edge_in_face(int edge, int face) {
    int corners = 0;
    for (const int corner : kFaceCorners[face]) corners += (corner == kEdgeCorners[edge][0]) + (corner == kEdgeCorners[edge][1]);
    return corners == 2;
}

/// Hit number of the loop around which a fan has no chord within a face; -1: there is none.
int articulation_centre(const CellLoops& loops, int loop) {
    const int n = loops.size(loop);
    const std::uint8_t* hits = loops.edge.data() + loops.begin[loop];
    for (int centre = 0; centre < n; ++centre) {
        bool legal = true;
        for (int step = 2; step <= n - 2; ++step) legal = legal && !edges_share_face(hits[centre], hits[(centre + step) % n]);
        if (legal) return centre;
    }
    return -1;
}

void add_triangle(CellTriangles& cell, int a, int b, int c) {
    std::uint8_t* corner = cell.corner.data() + 3 * cell.triangles++;
    corner[0] = static_cast<std::uint8_t>(a);
    corner[1] = static_cast<std::uint8_t>(b);
    corner[2] = static_cast<std::uint8_t>(c);
}

void add_loop(const CellLoops& loops, int loop, int centre, CellTriangles& cell) {
    const int n = loops.size(loop);
    const std::uint8_t* hits = loops.edge.data() + loops.begin[loop];
    if (centre >= 0) {
        for (int step = 1; step + 1 < n; ++step) add_triangle(cell, hits[centre], hits[(centre + step) % n], hits[(centre + step + 1) % n]);
        return;
    }
    const int point = 12 + cell.articulation_points;
    cell.articulation_loop[cell.articulation_points++] = static_cast<std::uint8_t>(loop);
    for (int i = 0; i < n; ++i) add_triangle(cell, point, hits[i], hits[(i + 1) % n]);
}

std::vector<CellTriangles> make_table(SurfaceStyle style) {
    std::vector<CellTriangles> table(kCellCases);
    for (int number = 0; number < kCellCases; ++number) {
        const CellLoops& loops = cell_cases().loops[number];
        int large = 0;
        for (int loop = 0; loop < loops.count; ++loop) large += loops.size(loop) > 3;
        for (int loop = 0; loop < loops.count; ++loop) {
            const bool alone = loops.size(loop) == 3 || large == 1;
            add_loop(loops, loop, style == SurfaceStyle::compact && alone ? articulation_centre(loops, loop) : -1, table[number]);
        }
    }
    return table;
}

}  // namespace

bool edges_share_face(int edge, int other) {
    for (int f = 0; f < 6; ++f) {
        if (edge_in_face(edge, f) && edge_in_face(other, f)) return true;
    }
    return false;
}

const std::vector<CellTriangles>& cell_triangles(SurfaceStyle style) {
    static const std::vector<CellTriangles> full = make_table(SurfaceStyle::full);
    static const std::vector<CellTriangles> compact = make_table(SurfaceStyle::compact);
    return style == SurfaceStyle::full ? full : compact;
}

}  // namespace isoatlas
