// Is there a tunnel through a cell at one isovalue? Recomputed from the cell alone (docs/theory/6-interior.md#finding-them).
// In the literature: the interior test of Marching Cubes 33 (Chernyaev 1995).
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "critical/tunnels.h"
#include "field/sample_grid.h"

namespace isoatlas {

/// A tunnel at one isovalue. Regions: bit k for corner k of the cell.
struct OpenTunnel {
    bool joins_highs;            ///< else Lows
    std::uint8_t a, b, ring;     ///< the regions it joins, and the one of the other class around it
    std::array<double, 3> body;  ///< position of its body point in the cell, 0..1
};

template <class T>
class TunnelFinder {
public:
    /// tunnel_height: of tunnel_height_of (critical/bodies.h); infinite: there are none.
    TunnelFinder(const SampleGrid<T>& grid, double tau, double tunnel_height) : grid_(grid), tau_(tau), tunnel_height_(tunnel_height) {}
    [[nodiscard]] bool finds_any() const { return grid_.is_3d() && std::isfinite(tunnel_height_); }

    /// cell: corner 0; all corners must be voxels. pattern, joined: the cell at tau.
    [[nodiscard]] std::optional<OpenTunnel> operator()(const Index3& cell, int pattern, int joined) const {
        if (!may_hold_tunnel(pattern, joined)) return std::nullopt;
        return find(cell, pattern, joined);
    }
    /// The samples at the corners.
    [[nodiscard]] std::array<double, 8> values(const Index3& cell) const;

private:
    [[nodiscard]] std::optional<OpenTunnel> find(const Index3& cell, int pattern, int joined) const;

    SampleGrid<T> grid_;
    double tau_, tunnel_height_;
};

}  // namespace isoatlas
