// The saddle of the trilinear interpolant inside a cell (trilinear.md sections 2 and 3, bodySaddle).
#pragma once

#include <array>
#include <optional>

namespace isoatlas {

struct BodySaddle {
    double value;
    std::array<double, 3> position;  ///< strictly inside the unit cube
};

/// The saddle of index 1 (two regions of Highs join there) strictly inside the cell with these corner values; that of index 2 is the one of
/// the negated values. Cost: one square root.
std::optional<BodySaddle> body_saddle(const std::array<double, 8>& value);

/// The values times a power of two, so that products of six of them neither overflow nor vanish; as they are when they need none.
/// exponent: the power that was taken away.
std::array<double, 8> scaled(const std::array<double, 8>& value, int& exponent);

/// The trilinear interpolant. position: 0..1.
double interpolate(const std::array<double, 8>& value, const std::array<double, 3>& position);

}  // namespace isoatlas
