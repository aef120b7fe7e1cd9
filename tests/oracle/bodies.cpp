#include "oracle/bodies.h"

#include "critical/bodies.h"

namespace oracle {
namespace {

isoatlas::CellElements cell_of(const Grid& grid, const std::array<Index, 3>& p) {
    isoatlas::CellElements cell{};
    for (int k = 0; k < 8; ++k) {
        cell.voxel[k] = grid.index(p[0] + (k & 1), p[1] + (k >> 1 & 1), p[2] + (k >> 2));
        cell.value[k] = grid.value[cell.voxel[k]];
    }
    isoatlas::find_ambiguous_faces(cell);
    return cell;
}

}  // namespace

Elements elements_of(const Grid& grid, isoatlas::Interpolant interpolant, double tunnel_height) {
    std::vector<Body> bodies;
    const double height = isoatlas::tunnel_height_of(interpolant, tunnel_height);
    for (Index v = 0; grid.rank == 3 && interpolant == isoatlas::Interpolant::trilinear && v < grid.voxels(); ++v) {
        const std::array<Index, 3> p = grid.voxel(v);
        if (!grid.contains({p[0] + 1, p[1] + 1, p[2] + 1})) continue;
        const isoatlas::CellElements cell = cell_of(grid, p);
        const isoatlas::CellBodies found = isoatlas::bodies_of_cell(cell, isoatlas::default_face_types(cell), height);
        if (found.opening) bodies.push_back({v, found.opening->face, true, found.opening->value});
        if (found.closing) bodies.push_back({v, found.closing->face, false, found.closing->value});
    }
    return Elements(grid, bodies);
}

}  // namespace oracle
