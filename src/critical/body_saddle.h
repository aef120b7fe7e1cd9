// The saddle of the trilinear interpolant inside a cell (docs/theory/6-interior.md#finding-them).
// In the literature: critical points of the trilinear interpolant (Nielson, On Marching Cubes, 2003).
#pragma once

#include <array>
#include <optional>

#include "critical/exact_cell.h"

namespace isoatlas {

struct BodySaddle {
    double value;                    ///< rounded down (field/rounding.h)
    std::array<double, 3> position;  ///< strictly inside the unit cube; approximate
};

/// The saddle of this kind strictly inside the cell. Decided exactly; the same value for mirrored and rotated cells. Cost: about 400 flops;
/// some microseconds where twice the precision of doubles does not decide.
std::optional<BodySaddle> body_saddle(const CellValues& value, SaddleKind kind);

/// The trilinear interpolant. position: 0..1.
double interpolate(const CellValues& value, const std::array<double, 3>& position);

}  // namespace isoatlas
