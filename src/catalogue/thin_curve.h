// Reduces a curve to the points that a plot can resolve.
#pragma once

#include "isoatlas/simplify.h"

namespace isoatlas {

/// The first and the last point, and those between at equal distances on a logarithmic scale of `kept`, at most `points` in all.
[[nodiscard]] SelectionCurve thin_curve(const SelectionCurve& curve, std::int64_t points);

}  // namespace isoatlas
