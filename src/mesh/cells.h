// From active cells to triangles: counting first, then writing in place.
#pragma once

#include "critical/bodies.h"
#include "mesh/cell_triangles.h"
#include "mesh/layout.h"
#include "mesh/physical_map.h"
#include "mesh/tunnel_cell.h"

namespace isoatlas {

/// A cell whose triangles follow from which of its corners are High: no face is split, and it has no points of its own.
struct PlainCell {
    std::uint8_t triangles = 0;             ///< 0: it is none
    std::array<std::uint8_t, 15> corner{};  ///< as in CellTriangles
};
/// One entry per pattern. tunnels: may cells have any?
[[nodiscard]] std::array<PlainCell, 256> plain_cells(SurfaceStyle style, bool tunnels, bool flip);

template <class T>
class CellWriter {
public:
    /// flip: the geometry is mirrored, so triangles must turn the other way round to keep their normals towards lower values.
    CellWriter(const SampleGrid<T>& grid, double tau, const MeshDomain& domain, const PhysicalMap& map, const ExtractOptions& options,
               bool flip)
        : joiner_{grid, tau},
          tunnels_(grid, tau, tunnel_height_of(options.interpolant, options.tunnel_height)),
          extent_(grid.extent),
          origin_(grid.origin),
          domain_(domain),
          map_(map),
          style_(options.style),
          triangles_(cell_triangles(options.style)),
          flip_(flip),
          plain_(plain_cells(options.style, tunnels_.finds_any(), flip)) {}

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
    /// Has row (y, z) cells that may have tunnels?
    [[nodiscard]] bool has_tunnels(std::int64_t y, std::int64_t z) const;
    /// Cell p of row (y, z), which is not plain.
    [[nodiscard]] State state_of(std::int64_t p, std::int64_t y, std::int64_t z, int pattern, bool has_tunnels) const;
    /// Writes the triangles and points of a cell that is not plain. point: of its hits; next_point, triangle: places, moved on.
    void write_cell(const State& state, const std::array<std::int64_t, 3>& voxel, std::int64_t* point, std::int64_t& next_point,
                    std::array<std::int64_t, 3>*& triangle, Surface& surface) const;
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
    std::array<PlainCell, 256> plain_;
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
    /// Writes the points of edges 0..11; entries of edges that are not hit mean nothing.
    void points_of(int pattern, std::int64_t* point) {
        const std::array<std::int64_t, 8>& hits = hits_of_patterns()[static_cast<std::size_t>(pattern)];
        std::array<std::int64_t, 8> after;
        for (std::size_t i = 0; i < 8; ++i) after[i] = next_[i] + hits[i];
        for (std::size_t i = 0; i < 4; ++i) point[i] = next_[i];  // along x: one row each
        for (std::size_t i = 4; i < 8; ++i) {  // along y and z: a near and a far edge in one row; the far one is the next cell's near one
            point[2 * i - 4] = next_[i];
            point[2 * i - 3] = after[i];
        }
        next_ = after;
    }

private:
    /// Per pattern: which of the edges 0, 1, 2, 3, 4, 6, 8, 10 are hit?
    static const std::array<std::array<std::int64_t, 8>, 256>& hits_of_patterns();

    std::array<std::int64_t, 8> next_;
};

}  // namespace isoatlas
