// Triangles between two closed polygons in neighbouring slices: a strip of which each triangle has one edge of one polygon.
//
// The strips that begin at corner `start` of the lower polygon are the paths in a grid from (start, 0) to (start + m, n): a step to the
// next row is a triangle on an edge of the lower polygon, one to the next column a triangle on an edge of the upper one. The cheapest path
// has the smallest area. Cheapest paths from different starts do not cross, so all starts together cost O(m n log m). In the literature:
// Keppel, Approximating complex surfaces by triangulation of contour lines, 1975; Fuchs, Kedem, Uselton, Optimal surface reconstruction
// from planar contours, 1977. Of long polygons: the shorter diagonal next (Christiansen, Sederberg, 1978).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

struct Strip {
    std::int64_t start = 0;        ///< corner of the lower polygon; the upper one begins at its corner 0
    std::vector<bool> is_lower{};  ///< of each triangle: on an edge of the lower polygon
};

inline constexpr std::int64_t kMaxOptimalGrid = std::int64_t{1} << 16;  ///< corners times corners

/// The strip of the smallest area; of polygons with more than kMaxOptimalGrid pairs of corners one by shorter diagonals. At least 3 corners
/// each.
[[nodiscard]] Strip tile(std::span<const Vec3> lower, std::span<const Vec3> upper);

/// Sum of the areas of its triangles.
[[nodiscard]] double area_of(const Strip& strip, std::span<const Vec3> lower, std::span<const Vec3> upper);

}  // namespace isoatlas
