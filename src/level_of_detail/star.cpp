#include "level_of_detail/star.h"

#include <algorithm>

namespace isoatlas {
namespace {

constexpr std::size_t kMaxStar = 48;  ///< triangles of a star

void add_once(std::vector<std::uint32_t>& points, std::uint32_t point) {
    if (std::ranges::find(points, point) == points.end()) points.push_back(point);
}

}  // namespace

bool Star::find(const CollapsibleMesh& mesh, std::uint32_t of_gone, std::uint32_t of_kept, bool are_at_rim) {
    gone = of_gone, kept = of_kept;
    triangles.clear();
    ring.clear();
    std::size_t common_triangles = 0, around_gone = 0, around_kept = 0, common = 0;
    mesh.for_fan(gone, [&](std::uint32_t corner) {
        const std::uint32_t b = mesh.point(next_corner(corner)), c = mesh.point(last_corner(corner));
        const bool disappears = b == kept || c == kept;
        triangles.push_back({corner / 3, gone, b, c, disappears});
        common_triangles += disappears ? 1 : 0;
        ++around_gone;
        for (const std::uint32_t point : {b, c}) {
            if (point != kept) add_once(ring, point);
        }
    });
    const std::size_t ring_of_gone = ring.size();
    if (around_gone > kMaxStar) return false;
    const auto is_around_gone = [&](std::uint32_t point) {
        return std::find(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(ring_of_gone), point) !=
               ring.begin() + static_cast<std::ptrdiff_t>(ring_of_gone);
    };
    const std::size_t after_gone = triangles.size();
    mesh.for_fan(kept, [&](std::uint32_t corner) {
        const std::uint32_t b = mesh.point(next_corner(corner)), c = mesh.point(last_corner(corner));
        ++around_kept;
        if (b != gone && c != gone) triangles.push_back({corner / 3, kept, b, c, false});
    });
    if (triangles.size() > kMaxStar) return false;
    for (std::size_t i = after_gone; i < triangles.size(); ++i) {
        for (const std::uint32_t point : {triangles[i].b, triangles[i].c}) {
            if (!is_around_gone(point)) add_once(ring, point);
        }
    }
    for (std::size_t i = 0; i < ring_of_gone; ++i) {
        bool is_around_kept = false;
        for (const StarTriangle& t : triangles) {
            is_around_kept = is_around_kept || ((t.apex == kept || t.disappears) && (t.b == ring[i] || t.c == ring[i]));
        }
        common += is_around_kept ? 1 : 0;
    }
    if (common_triangles == 2) return !are_at_rim && common == 2 && (around_gone > 3 || around_kept > 3);  // both 3: a tetrahedron
    return common_triangles == 1 && are_at_rim && common == 1 && (around_gone > 1 || around_kept > 1);
}

}  // namespace isoatlas
