#include "mesh/plain_cells.h"

#include <utility>

#include "base/check.h"
#include "critical/tunnels.h"

namespace isoatlas {
namespace {

/// Among the 16 numbers, the one of an edge.
std::uint8_t number_of(std::uint8_t edge) {
    if (edge < 4) return edge;
    return static_cast<std::uint8_t>(edge % 2 == 0 ? 2 + edge / 2 : 10 + edge / 2);
}

}  // namespace

PlainCells::PlainCells(SurfaceStyle style, bool tunnels, bool flip) {
    for (int pattern = 1; pattern < 255; ++pattern) {
        const auto entry = static_cast<std::size_t>(pattern);
        for (std::size_t i = 0; i < kCounterEdges.size(); ++i)
            moves[entry] |= static_cast<std::uint8_t>((cell_cases().hit_edges[pattern] >> kCounterEdges[i] & 1) << i);
        const CellTriangles& cell = cell_triangles(style)[cell_cases().first_case[pattern]];
        if (cell_cases().split_faces[pattern] != 0 || cell.articulation_points != 0 || (tunnels && may_hold_tunnel(pattern, 0))) continue;
        ISOATLAS_CHECK(3U * cell.triangles < corner[entry].size());
        triangles[entry] = cell.triangles;
        for (std::size_t i = 0; i < 3U * cell.triangles; ++i) corner[entry][i] = number_of(cell.corner[i]);
        for (std::size_t i = 0; flip && i < cell.triangles; ++i) std::swap(corner[entry][3 * i + 1], corner[entry][3 * i + 2]);
    }
}

}  // namespace isoatlas
