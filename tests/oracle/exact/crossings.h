// Does a triangle mesh cross itself? Decided with exact predicates (CGAL) on the coordinates as they are: no tolerance, no rounding.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace oracle {

using MeshPoints = std::span<const std::array<double, 3>>;
using MeshTriangles = std::span<const std::array<std::int64_t, 3>>;

struct Crossings {
    std::int64_t pairs = 0;      ///< pairs of triangles whose boxes touch: all that were tested
    std::int64_t crossings = 0;  ///< pairs that meet in more than the points they share by index
    std::int64_t flat = 0;       ///< triangles whose points are collinear; they are in no pair
    std::string first;           ///< the first crossing, with coordinates; empty: none
    [[nodiscard]] bool none() const { return crossings == 0 && flat == 0; }
};
Crossings find_crossings(MeshPoints points, MeshTriangles triangles);

}  // namespace oracle
