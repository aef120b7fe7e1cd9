#include "geometry/contours.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "base/union_find.h"

namespace isoatlas {
namespace {

using Edge = std::array<std::int64_t, 2>;  // points, ascending

BigVector<Edge> sorted_edges(const MeshView& mesh, int threads) {
    BigVector<Edge> edges(3 * mesh.triangles.size());
    for_each_index(threads, mesh.triangles.size(), [&](std::size_t t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int64_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
            edges[3 * t + i] = {std::min(a, b), std::max(a, b)};
        }
    });
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// Calls visit(edge, triangles) for every edge.
template <class Visit>
void for_each_edge(const BigVector<Edge>& edges, const Visit& visit) {
    for (std::size_t begin = 0; begin < edges.size();) {
        std::size_t end = begin + 1;
        while (end < edges.size() && edges[end] == edges[begin]) ++end;
        visit(edges[begin], end - begin);
        begin = end;
    }
}

/// Seen along the first axis.
Vec2 seen(const Vec3& p) { return {p[1], p[2]}; }

/// orientation(a, b, p) of a p that is moved by (e, e^2), e infinitely small. 0: a is b.
int orientation_beside(const Vec2& a, const Vec2& b, const Vec2& p) {
    const int sign = orientation(a, b, p);
    if (sign != 0) return sign;
    if (a[1] != b[1]) return a[1] > b[1] ? 1 : -1;
    return a[0] == b[0] ? 0 : b[0] > a[0] ? 1 : -1;
}

/// Does the ray from p along the first axis, moved beside p, meet the triangle?
bool ray_meets(const Vec3& p, const std::array<Vec3, 3>& t) {
    const Vec2 a = seen(t[0]), b = seen(t[1]), c = seen(t[2]), q = seen(p);
    const int turn = orientation(a, b, c);
    if (turn == 0) return false;
    if (orientation_beside(a, b, q) != turn || orientation_beside(b, c, q) != turn || orientation_beside(c, a, q) != turn) return false;
    return orientation(t[0], t[1], t[2], p) == -turn;  // the normal points along the ray where they turn to the left
}

}  // namespace

bool MeshContours::all_closed() const {
    return std::all_of(list.begin(), list.end(), [](const MeshContour& contour) { return contour.rims == 0; });
}

std::int64_t MeshContours::genus() const {
    return std::accumulate(list.begin(), list.end(), std::int64_t{0},
                           [](std::int64_t sum, const MeshContour& contour) { return sum + contour.genus(); });
}

MeshContours find_contours(const MeshView& mesh, const Context& context) {
    UnionFind<std::int64_t> sets(mesh.points.size()), rims(mesh.points.size());
    MeshContours contours{{}, BigVector<std::int64_t>(mesh.points.size())};
    std::fill(contours.contour_of.begin(), contours.contour_of.end(), -1);
    for (const TriangleCorners& t : mesh.triangles) {
        sets.join(sets.join(t[0], t[1]), t[2]);
        for (const std::int64_t point : t) contours.contour_of[static_cast<std::size_t>(point)] = 0;
    }
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        std::int64_t& contour = contours.contour_of[i];
        if (contour < 0) continue;
        const auto point = static_cast<std::int64_t>(i), root = sets.find(point);  // the root is the lowest
        if (root == point) {
            contour = static_cast<std::int64_t>(contours.list.size());
            contours.list.push_back({.first_point = point});
        }
        contour = contours.contour_of[static_cast<std::size_t>(root)];
        MeshContour& found = contours.list[static_cast<std::size_t>(contour)];
        ++found.points, ++found.chi;
    }
    const auto contour_at = [&](std::int64_t point) -> MeshContour& {
        return contours.list[static_cast<std::size_t>(contours.contour_of[static_cast<std::size_t>(point)])];
    };
    for (const TriangleCorners& t : mesh.triangles) ++contour_at(t[0]).triangles, ++contour_at(t[0]).chi;
    std::vector<std::uint8_t> on_rim(mesh.points.size());
    const BigVector<Edge> edges = sorted_edges(mesh, context.threads);
    for_each_edge(edges, [&](const Edge& edge, std::size_t triangles) {
        --contour_at(edge[0]).chi;
        if (triangles == 1) {
            rims.join(edge[0], edge[1]);
            for (const std::int64_t point : edge) on_rim[static_cast<std::size_t>(point)] = 1;
        }
    });
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {  // each rim once: at its lowest point
        const auto point = static_cast<std::int64_t>(i);
        if (on_rim[i] != 0 && rims.find(point) == point) ++contour_at(point).rims;
    }
    return contours;
}

std::vector<std::vector<std::int64_t>> find_enclosing(const MeshView& mesh, const MeshContours& contours, const Context& context) {
    const TriangleTree tree(mesh.points, mesh.triangles, context.threads);
    std::vector<std::vector<std::int64_t>> enclosing(contours.list.size());
    for_each_block(context.threads, static_cast<std::int64_t>(enclosing.size()), [&](std::int64_t i) {
        const Vec3& p = mesh.points[static_cast<std::size_t>(contours.list[static_cast<std::size_t>(i)].first_point)];
        const BoundingBox ray{p, {std::numeric_limits<double>::infinity(), p[1], p[2]}};
        std::vector<std::int64_t> met;
        tree.for_each_leaf(ray, 0, [&](std::size_t leaf) {
            for (const std::int64_t triangle : tree.leaf(leaf)) {
                const std::int64_t corner = mesh.triangles[static_cast<std::size_t>(triangle)][0];
                const std::int64_t contour = contours.contour_of[static_cast<std::size_t>(corner)];
                if (contour != i && ray_meets(p, tree.corners(triangle))) met.push_back(contour);
            }
        });
        std::sort(met.begin(), met.end());
        for (auto begin = met.begin(); begin != met.end();) {
            const auto end = std::upper_bound(begin, met.end(), *begin);
            if ((end - begin) % 2 == 1 && contours.list[static_cast<std::size_t>(*begin)].rims == 0)
                enclosing[static_cast<std::size_t>(i)].push_back(*begin);
            begin = end;
        }
    });
    return enclosing;
}

}  // namespace isoatlas
