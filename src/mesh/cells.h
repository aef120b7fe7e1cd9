// From active cells to triangles: counting first, then writing in place.
#pragma once

#include "critical/bodies.h"
#include "field/grid.h"
#include "mesh/cell_triangles.h"
#include "mesh/layout.h"
#include "mesh/physical_map.h"
#include "mesh/tunnel_cell.h"

namespace isoatlas {

template <class T>
class CellWriter {
public:
    /// flip: the geometry is mirrored, so triangles must turn the other way round to keep their normals towards lower values.
    CellWriter(const GridView<T>& grid, double tau, const MeshDomain& domain, const PhysicalMap& map, const ExtractOptions& options,
               bool flip)
        : joiner_(grid, tau),
          tunnels_(grid, tau, tunnel_height_of(options.interpolant, options.tunnel_height)),
          extent_(grid.extent),
          origin_(grid.origin),
          domain_(domain),
          map_(map),
          style_(options.style),
          triangles_(cell_triangles(options.style)),
          flip_(flip) {}

    /// Adds the triangles and articulation points of cell row (y, z) to the counts of its place.
    void count_row(std::int64_t y, std::int64_t z, RowPlace& place) const;
    /// Writes triangles and articulation points (with normals and contours when the surface has them). All hits are already written.
    void write_row(std::int64_t y, std::int64_t z, const Layout& layout, Surface& surface) const;

private:
    /// A cell at tau.
    struct State {
        int pattern, joined, number;
        std::optional<OpenTunnel> tunnel;
    };
    /// Calls visit(p, state) for every active cell of row (y, z).
    template <class Visit>
    void for_cells(std::int64_t y, std::int64_t z, Visit&& visit) const;
    /// Writes the points of a cell with a tunnel behind its hits in `point`; next: the first of their places.
    void write_points(const State& state, const TunnelCell& cell, const std::array<std::int64_t, 3>& voxel, std::int64_t next,
                      std::int64_t* point, Surface& surface) const;
    [[nodiscard]] std::array<float, 3> normal_at(const std::array<double, 8>& value, const std::array<std::int64_t, 3>& voxel,
                                                 const Vec3& position) const;

    FaceJoiner<T> joiner_;
    TunnelFinder<T> tunnels_;
    Extent extent_;
    std::array<std::int64_t, 3> origin_;
    const MeshDomain& domain_;
    const PhysicalMap& map_;
    SurfaceStyle style_;
    const std::vector<CellTriangles>& triangles_;
    bool flip_;
};

/// The point of every hit edge of a cell, while walking along a row of cells.
class HitCursor {
public:
    HitCursor(const MeshDomain& domain, const Layout& layout, std::int64_t y, std::int64_t z) {
        const RowPlace& r00 = layout[domain.row_number(y, z)];
        const RowPlace& r10 = layout[domain.row_number(y + 1, z)];
        const RowPlace& r01 = layout[domain.row_number(y, z + 1)];
        const RowPlace& r11 = layout[domain.row_number(y + 1, z + 1)];
        next_ = {r00.point, r10.point, r01.point, r11.point, r00.first_y(), r01.first_y(), r00.first_z(), r10.first_z()};
    }
    /// Writes the points of edges 0..11; entries of edges that are not hit mean nothing. hit_edges: bit e set when edge e is hit.
    void points_of(unsigned hit_edges, std::int64_t* point) {
        const auto hit = [hit_edges](int e) { return static_cast<std::int64_t>(hit_edges >> e & 1); };
        for (int e = 0; e < 4; ++e) {  // along x: one row each
            point[e] = next_[e];
            next_[e] += hit(e);
        }
        for (int i = 0; i < 4; ++i) {  // along y and z: a near and a far edge in one row; the far one is the next cell's near one
            const int near = 4 + 2 * i;
            point[near] = next_[4 + i];
            next_[4 + i] += hit(near);
            point[near + 1] = next_[4 + i];
        }
    }

private:
    std::array<std::int64_t, 8> next_;
};

}  // namespace isoatlas
