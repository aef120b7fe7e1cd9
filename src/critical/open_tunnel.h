// Is there a tunnel through a cell at one isovalue? Recomputed from the cell alone (trilinear.md section 3).
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "critical/tunnels.h"
#include "field/grid.h"
#include "field/order.h"

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
    TunnelFinder(const GridView<T>& grid, double tau, double tunnel_height)
        : grid_(grid), steps_(grid.extent), tau_(tau), tunnel_height_(tunnel_height) {}
    [[nodiscard]] bool finds_any() const { return grid_.is_3d() && std::isfinite(tunnel_height_); }

    /// cell: the voxel of corner 0; all corners must be voxels. pattern, joined: the cell at tau.
    [[nodiscard]] std::optional<OpenTunnel> operator()(std::int64_t cell, int pattern, int joined) const {
        if (!may_hold_tunnel(pattern, joined)) return std::nullopt;
        return find(cell, pattern, joined);
    }
    /// The samples at the corners.
    [[nodiscard]] std::array<double, 8> values(std::int64_t cell) const;

private:
    [[nodiscard]] std::optional<OpenTunnel> find(std::int64_t cell, int pattern, int joined) const;

    GridView<T> grid_;
    GridSteps steps_;
    double tau_, tunnel_height_;
};

}  // namespace isoatlas
