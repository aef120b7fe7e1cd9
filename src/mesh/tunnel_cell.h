// The triangles of a cell with an open tunnel: an annulus between two loops (docs/theory/6-interior.md#the-annulus).
//
// Seen from a point c inside the cell, the annulus is the radial graph over the ring, the region of the other class around the tunnel:
// every corner k of the ring is pulled towards c to a point w_k of the surface, and every part of the ring on a face of the cell becomes
// triangles with these points and the hits. The projection from c maps the cell's boundary one-to-one to a sphere, so the triangles do not
// meet inside the cell; they have no edge between two hits of one face but the links, so they do not meet in the neighbours.
//
// In the literature: the tunnel cases of Marching Cubes 33 (Chernyaev 1995; Grosso, Construction of topologically correct and manifold
// isosurfaces, 2016).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "critical/open_tunnel.h"
#include "field/cell_loops.h"
#include "isoatlas/surface.h"

namespace isoatlas {

/// A corner of a triangle is an edge 0..11 (the hit there), or 12 + i: point i of the cell.
struct TunnelCell {
    std::uint8_t triangles = 0, ring_points = 0, articulation_points = 0;
    std::array<std::uint8_t, 6> ring_corner{};        ///< of points 0 .. ring_points - 1: the corner of the cell that is pulled in
    std::array<std::uint8_t, 2> articulation_loop{};  ///< of the points behind: articulation points of loops that do not bound the tunnel
    std::uint8_t hit = 0;                             ///< a hit of the annulus
    std::array<std::uint8_t, 3 * 24> corner{};        ///< 3 per triangle, counter-clockwise seen from the Lows

    [[nodiscard]] int points() const { return ring_points + articulation_points; }
};

/// pattern, joined: the cell at the isovalue of the tunnel.
TunnelCell tunnel_cell(int pattern, int joined, const OpenTunnel& tunnel, SurfaceStyle style);

/// Positions of the ring points in the cell, 0..1. value: the samples at its corners.
std::array<Vec3, 6> ring_points(const TunnelCell& cell, const OpenTunnel& tunnel, int pattern, int joined,
                                const std::array<double, 8>& value, double tau);

}  // namespace isoatlas
