#include "isoatlas/surface_defects.h"

#include <algorithm>

#include "base/union_find.h"
#include "methods/surfaces/grid_positions.h"

namespace isoatlas {
namespace {

using Edge = SurfaceDefects::Edge;

/// Two sides that are parallel or have no length: as inspect() counts them.
bool has_zero_area(const Surface& surface, const std::array<std::int64_t, 3>& triangle) {
    const Vec3 &p = surface.points[triangle[0]], &q = surface.points[triangle[1]], &r = surface.points[triangle[2]];
    const Vec3 a{q[0] - p[0], q[1] - p[1], q[2] - p[2]}, b{r[0] - p[0], r[1] - p[1], r[2] - p[2]};
    return a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2] && a[0] * b[1] == a[1] * b[0];
}

/// Counts the closed lines that edges with one triangle make: at each of their points two of them meet.
void count_rims(const std::vector<Edge>& open, SurfaceDefects& defects) {
    std::vector<std::int64_t> points;
    for (const Edge& edge : open) points.insert(points.end(), edge.begin(), edge.end());
    std::ranges::sort(points);
    for (std::size_t i = 2; i < points.size(); ++i) defects.rims_meet |= points[i] == points[i - 2];
    points.erase(std::unique(points.begin(), points.end()), points.end());
    UnionFind<std::size_t> lines(points.size());
    const auto place = [&](std::int64_t point) {
        return static_cast<std::size_t>(std::ranges::lower_bound(points, point) - points.begin());
    };
    defects.rims = std::ssize(points);
    for (const Edge& edge : open) {
        const std::size_t p = lines.find(place(edge[0])), q = lines.find(place(edge[1]));
        if (p == q) continue;
        static_cast<void>(lines.join(p, q));
        --defects.rims;
    }
}

/// Counts the components and the points that triangles use.
std::int64_t count_components(const Surface& surface, SurfaceDefects& defects) {
    UnionFind<std::size_t> sets(surface.points.size());
    std::vector<bool> is_used(surface.points.size());
    for (const auto& t : surface.triangles) {
        for (const std::int64_t point : t) is_used[static_cast<std::size_t>(point)] = true;
        static_cast<void>(sets.join(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1])));
        static_cast<void>(sets.join(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[2])));
    }
    std::int64_t used = 0;
    for (std::size_t point = 0; point < is_used.size(); ++point) {
        used += is_used[point] ? 1 : 0;
        defects.components += is_used[point] && sets.find(point) == point ? 1 : 0;
    }
    return used;
}

}  // namespace

SurfaceDefects find_defects(const Surface& surface, const VolumeInfo& info) {
    const GridPositions positions(info);
    SurfaceDefects defects;
    std::vector<Edge> edges, open;
    for (std::size_t number = 0; number < surface.triangles.size(); ++number) {
        const auto& t = surface.triangles[number];
        for (std::size_t i = 0; i < 3; ++i) edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
        if (has_zero_area(surface, t)) defects.zero_area_triangles.push_back(static_cast<std::int64_t>(number));
    }
    defects.euler = count_components(surface, defects) + std::ssize(surface.triangles);
    std::ranges::sort(edges);
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        const Edge& edge = edges[begin];
        --defects.euler;
        for (end = begin; end < edges.size() && edges[end] == edge; ++end) {
        }
        if (end - begin > 2) defects.non_manifold_edges.push_back(edge);
        if (end - begin != 1) continue;
        open.push_back(edge);
        if ((positions.ends_of(surface.points[edge[0]]) & positions.ends_of(surface.points[edge[1]])) == 0)
            defects.hole_edges.push_back(edge);
    }
    count_rims(open, defects);
    return defects;
}

std::optional<std::int64_t> genus_of(const SurfaceDefects& defects) {
    if (defects.rims_meet || !defects.non_manifold_edges.empty()) return std::nullopt;
    return (2 * defects.components - defects.euler - defects.rims) / 2;
}

}  // namespace isoatlas
