// From active cells to triangles: PASS 1 counts, PASS 4 writes in place (mesh/layout.h).
// In the literature: count, then write in place: Flying Edges (Schroeder, Maynard, Geveci 2015).
#pragma once

#include <vector>

#include "critical/bodies.h"
#include "mesh/cell_triangles.h"
#include "mesh/layout.h"
#include "mesh/physical_map.h"
#include "mesh/plain_cells.h"
#include "mesh/tunnel_cell.h"

namespace isoatlas {

template <class T>
class CellWriter {
public:
    /// flip: the geometry is mirrored, so triangles are oriented the other way round to keep their normals towards lower values.
    CellWriter(const SampleGrid<T>& grid, double tau, const MeshDomain& domain, const PhysicalMap& map, const ExtractOptions& options,
               bool flip)
        : joiner_{grid, tau},
          tunnels_(grid, tau, tunnel_height_of(options.interpolant, options.tunnel_height)),
          extent_(grid.extent),
          origin_(grid.origin),
          domain_(domain),
          map_(map),
          style_(options.surface.style),
          triangles_(cell_triangles(options.surface.style)),
          flip_(flip),
          plain_(options.surface.style, tunnels_.finds_any(), flip) {}

    /// Counts the hits of row (y, z), and the triangles and articulation points of its cells. Appends a number to `found` for each cell
    /// that is not plain: what its samples say, which write_row() need not read again.
    void count_row(std::int64_t y, std::int64_t z, RowOffsets& place, std::vector<std::uint8_t>& found) const;
    /// Writes triangles and articulation points (with normals and contours when the surface has them). All hits are already written.
    /// found: the number of the first cell of the row that is not plain; moved on, past the last one.
    void write_row(std::int64_t y, std::int64_t z, const Layout& layout, const std::uint8_t*& found, Surface& surface) const;

    /// A cell at tau.
    struct State {
        int pattern, joined, number;
        std::optional<OpenTunnel> tunnel;
    };
    /// How much a cell adds to a surface, beside its hits.
    struct Size {
        std::int64_t triangles, points;
    };
    /// Has row (y, z) cells that may have tunnels?
    [[nodiscard]] bool has_tunnels(std::int64_t y, std::int64_t z) const;
    /// Cell p of row (y, z).
    [[nodiscard]] State state_of(std::int64_t p, std::int64_t y, std::int64_t z, int pattern, bool has_tunnels) const;
    [[nodiscard]] Size size_of(const State& state) const;
    /// Writes the triangles and points of a cell. point: of its hits, by edges, and room for 8 more; next_point, triangle: places, moved
    /// on.
    void write_cell(const State& state, const Index3& voxel, std::int64_t* point, std::int64_t& next_point,
                    std::array<std::int64_t, 3>*& triangle, Surface& surface) const;

private:
    /// The state as a number: its joined faces, one bit each, and whether it has a tunnel.
    static constexpr std::uint8_t kHasTunnel = 1 << 6;
    /// The same from the number that count_row() has left: only a tunnel is computed once more.
    [[nodiscard]] State state_again(std::int64_t p, std::int64_t y, std::int64_t z, int pattern, std::uint8_t found) const;
    /// Writes the points of a cell with a tunnel behind its hits in `point`; next: the first of their places.
    void write_points(const State& state, const TunnelCell& cell, const Index3& voxel, std::int64_t next, std::int64_t* point,
                      Surface& surface) const;
    [[nodiscard]] std::array<float, 3> normal_at(const std::array<double, 8>& value, const Index3& voxel, const Vec3& position) const;

    FaceJoiner<T> joiner_;
    TunnelFinder<T> tunnels_;
    Extent extent_;
    Index3 origin_;
    const MeshDomain& domain_;
    const PhysicalMap& map_;
    SurfaceStyle style_;
    const std::vector<CellTriangles>& triangles_;
    bool flip_;
    PlainCells plain_;
};

}  // namespace isoatlas
