// Does a mesh cross itself? Every pair of triangles, decided exactly.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "geometry/triangle_tree.h"
#include "isoatlas/context.h"

namespace isoatlas {

struct Crossings {
    std::int64_t pairs = 0;                              ///< of triangles that meet in more than the corners they share
    std::optional<std::array<std::int64_t, 2>> first{};  ///< the least of these pairs, ascending
};

/// Finite coordinates. The same for any number of threads. Throws Error: cancelled. Cost: O(n log n), some 2 microseconds a triangle, where
/// few boxes of triangles meet.
[[nodiscard]] Crossings count_crossings(std::span<const Vec3> points, std::span<const TriangleCorners> triangles,
                                        const Context& context = {});

}  // namespace isoatlas
