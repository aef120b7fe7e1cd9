// Which tunnels a cell can hold, by its case (docs/theory/6-interior.md#six-shapes).
// In the literature: cases of Marching Cubes 33 with interior ambiguity (Chernyaev 1995; Custodio et al., Practical considerations on
// Marching Cubes 33, 2013).
#pragma once

#include <cstdint>

namespace isoatlas {

/// A tunnel joins the regions a and b of one class; the region `ring` of the other class lies around it. Bit k for corner k; a == 0: none.
struct TunnelShape {
    std::uint8_t a = 0, b = 0, ring = 0;
    [[nodiscard]] bool exists() const { return a != 0; }
    /// Does it join these two?
    [[nodiscard]] bool joins(unsigned p, unsigned q) const { return (a == p && b == q) || (a == q && b == p); }
};

/// The tunnel of Highs, or of Lows, that fits into a cell with this High pattern and these joined faces; at most one of each class. O(1).
const TunnelShape& tunnel_shape(int pattern, int joined, bool joins_highs);

/// Can such a cell hold a tunnel at all? 140 of 654 cases can.
bool may_hold_tunnel(int pattern, int joined);

}  // namespace isoatlas
