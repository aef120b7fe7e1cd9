#include "oracle/exact/hulls.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

namespace oracle {

bool hull_contains(const std::array<std::array<double, 3>, 4>& points, const std::array<double, 3>& p) {
    using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
    const Kernel::Point_3 point(p[0], p[1], p[2]);
    std::array<Kernel::Point_3, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = {points[i][0], points[i][1], points[i][2]};
    const Kernel::Tetrahedron_3 whole(corners[0], corners[1], corners[2], corners[3]);
    if (!whole.is_degenerate()) return !whole.has_on_unbounded_side(point);
    for (std::size_t i = 0; i < 4; ++i) {
        const Kernel::Triangle_3 side(corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4]);
        if (!side.is_degenerate() && side.has_on(point)) return true;
        for (std::size_t j = 0; j < i; ++j) {
            const Kernel::Segment_3 edge(corners[i], corners[j]);
            if (edge.is_degenerate() ? corners[i] == point : edge.has_on(point)) return true;
        }
    }
    return false;
}

}  // namespace oracle
