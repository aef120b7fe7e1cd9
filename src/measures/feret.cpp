#include "measures/feret.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "measures/vectors.h"

namespace isoatlas {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void keep_larger(FeretDiameters& feret, const Vec3& p, const Vec3& q) {
    const Vec3 along = minus(p, q);
    const double distance = norm(along);
    if (distance > feret.max) feret.max = distance, feret.max_direction = times(1 / distance, along);
}

/// The largest distance of two vertices, of all pairs.
void find_max(const std::vector<Vec3>& vertices, FeretDiameters& feret) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) keep_larger(feret, vertices[i], vertices[j]);
    }
}

void keep_smaller(FeretDiameters& feret, double width, const Vec3& direction) {
    if (width < feret.min) feret.min = width, feret.min_direction = direction;
}

/// Two facets and their common edge.
struct HullEdge {
    std::int32_t a, b;
    std::int32_t facet, other;
};

std::vector<HullEdge> edges_of(const ConvexHull& hull) {
    std::vector<std::tuple<std::int32_t, std::int32_t, std::int32_t>> sides;
    for (std::int32_t f = 0; f < std::ssize(hull.facets); ++f) {
        const auto& v = hull.facets[static_cast<std::size_t>(f)].vertex;
        for (std::size_t i = 0; i < 3; ++i) sides.emplace_back(std::min(v[i], v[(i + 1) % 3]), std::max(v[i], v[(i + 1) % 3]), f);
    }
    std::ranges::sort(sides);
    std::vector<HullEdge> edges;
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        const auto& [a, b, facet] = sides[i];
        const auto& [c, d, other] = sides[i + 1];
        if (a == c && b == d) edges.push_back({a, b, facet, other}), ++i;
    }
    return edges;
}

/// The hull as a graph: a linear function without a better neighbour has no better vertex.
class HullWalk {
public:
    HullWalk(const ConvexHull& hull, const std::vector<HullEdge>& edges) : vertices_(hull.vertices), neighbours_(hull.vertices.size()) {
        for (const HullEdge& edge : edges) {
            neighbours_[static_cast<std::size_t>(edge.a)].push_back(edge.b);
            neighbours_[static_cast<std::size_t>(edge.b)].push_back(edge.a);
        }
    }
    [[nodiscard]] const Vec3& at(std::int32_t v) const { return vertices_[static_cast<std::size_t>(v)]; }
    [[nodiscard]] const std::vector<std::int32_t>& around(std::int32_t v) const { return neighbours_[static_cast<std::size_t>(v)]; }

    /// The vertex farthest against a direction, from one near it.
    [[nodiscard]] std::int32_t farthest_against(const Vec3& direction, std::int32_t from) const {
        for (;;) {
            std::int32_t best = from;
            for (const std::int32_t w : around(from)) {
                if (dot(direction, at(w)) < dot(direction, at(best))) best = w;
            }
            if (best == from) return from;
            from = best;
        }
    }

private:
    const std::vector<Vec3>& vertices_;
    std::vector<std::vector<std::int32_t>> neighbours_;
};

/// The vertex farthest against each facet; from facet to facet across edges, as those of neighbours are near each other.
std::vector<std::int32_t> vertices_against(const ConvexHull& hull, const std::vector<HullEdge>& edges, const HullWalk& walk) {
    std::vector<std::vector<std::int32_t>> beside(hull.facets.size());
    for (const HullEdge& edge : edges) {
        beside[static_cast<std::size_t>(edge.facet)].push_back(edge.other);
        beside[static_cast<std::size_t>(edge.other)].push_back(edge.facet);
    }
    std::vector<std::int32_t> against(hull.facets.size(), -1), waiting;
    const auto visit = [&](std::int32_t f, std::int32_t near) {
        const auto i = static_cast<std::size_t>(f);
        if (against[i] >= 0) return;
        against[i] = walk.farthest_against(hull.facets[i].normal, near);
        waiting.push_back(f);
    };
    for (std::int32_t first = 0; first < std::ssize(hull.facets); ++first) {  // one is enough where every edge has two facets
        visit(first, 0);
        while (!waiting.empty()) {
            const auto f = static_cast<std::size_t>(waiting.back());
            waiting.pop_back();
            for (const std::int32_t other : beside[f]) visit(other, against[f]);
        }
    }
    return against;
}

/// The directions between the normals of two facets all touch their common edge. Against them lie, one after the other, vertices whose
/// edges are crossed: there two edges face each other, and the width may be least. The two vertices farthest from each other are those that
/// touch the planes of all directions near the one between them: one of them is an end of an edge that is walked along, with the other one
/// against it.
void along_edge(const HullWalk& walk, const HullEdge& edge, const Vec3& from, const Vec3& to, std::int32_t against, FeretDiameters& feret) {
    const Vec3 turn = minus(to, from), corner = walk.at(edge.a);
    for (double t = 0;;) {
        keep_larger(feret, corner, walk.at(against));
        keep_larger(feret, walk.at(edge.b), walk.at(against));
        double next = 2;
        std::int32_t next_against = -1;
        for (const std::int32_t w : walk.around(against)) {
            const Vec3 step = minus(walk.at(against), walk.at(w));
            const double gain = dot(turn, step);
            if (gain <= 0) continue;
            const double crossing = std::max(t, -dot(from, step) / gain);
            if (crossing < next) next = crossing, next_against = w;
        }
        if (next >= 1) return;
        const Vec3 direction = plus(from, times(next, turn));
        const double length = norm(direction);
        if (length > 1e-9) keep_smaller(feret, dot(direction, minus(corner, walk.at(against))) / length, times(1 / length, direction));
        t = next;
        against = next_against;  // dot(turn, .) falls with every step: the walk ends
    }
}

/// The least width is between a facet and a vertex or between two edges (Houle, Toussaint: Computing the width of a set, IEEE Transactions
/// on Pattern Analysis and Machine Intelligence 10, 1988).
void find_all(const ConvexHull& hull, FeretDiameters& feret) {
    const std::vector<HullEdge> edges = edges_of(hull);
    const HullWalk walk(hull, edges);
    const std::vector<std::int32_t> against = vertices_against(hull, edges, walk);
    for (std::size_t f = 0; f < hull.facets.size(); ++f) {
        const HullFacet& facet = hull.facets[f];
        keep_smaller(feret, dot(facet.normal, minus(walk.at(facet.vertex[0]), walk.at(against[f]))), facet.normal);
    }
    double bend = 0;
    for (const HullEdge& edge : edges) {
        const auto f = static_cast<std::size_t>(edge.facet);
        const Vec3 &from = hull.facets[f].normal, &to = hull.facets[static_cast<std::size_t>(edge.other)].normal;
        bend += norm(minus(walk.at(edge.a), walk.at(edge.b))) * std::atan2(norm(cross(from, to)), dot(from, to));
        along_edge(walk, edge, from, to, against[f], feret);
    }
    feret.mean = bend / (4 * std::numbers::pi);
}

/// In the plane: facets are edges.
void find_min_and_mean_2d(const ConvexHull& hull, FeretDiameters& feret) {
    double length = 0;
    for (const HullFacet& edge : hull.facets) {
        const Vec3& a = hull.vertices[static_cast<std::size_t>(edge.vertex[0])];
        double low = std::numeric_limits<double>::infinity();
        for (const Vec3& v : hull.vertices) low = std::min(low, dot(edge.normal, minus(v, a)));
        keep_smaller(feret, -low, edge.normal);
        length += norm(minus(hull.vertices[static_cast<std::size_t>(edge.vertex[1])], a));
    }
    feret.mean = length / std::numbers::pi;
}

}  // namespace

FeretDiameters feret_diameters(const ConvexHull& hull, int rank) {
    FeretDiameters feret;
    feret.max_direction = {1, 0, 0};
    if (rank == 2 || hull.facets.empty()) find_max(hull.vertices, feret);
    if (hull.facets.empty()) {
        feret.min = feret.mean = kNone;
        return feret;
    }
    feret.min = std::numeric_limits<double>::infinity();
    rank == 3 ? find_all(hull, feret) : find_min_and_mean_2d(hull, feret);
    return feret;
}

}  // namespace isoatlas
