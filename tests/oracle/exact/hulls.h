// Points in the convex hulls of others, by exact predicates of CGAL.
#pragma once

#include <array>

namespace oracle {

/// Of four points, which may lie in a plane, on a line or in one place: does their closed hull contain p?
bool hull_contains(const std::array<std::array<double, 3>, 4>& points, const std::array<double, 3>& p);

}  // namespace oracle
