#include <algorithm>
#include <numeric>
#include <string>

#include "base/union_find.h"
#include "field/order.h"
#include "isoatlas/surface.h"

namespace isoatlas {
namespace {

using Triangles = std::span<const std::array<std::int64_t, 3>>;
using Points = std::span<const Vec3>;

void check_indices(std::size_t points, Triangles triangles) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (const std::int64_t point : triangles[t]) {
            if (point >= 0 && point < static_cast<std::int64_t>(points)) continue;
            throw Error(ErrorKind::input, {.where = "triangle " + std::to_string(t),
                                           .what = "it refers to point " + std::to_string(point),
                                           .expected = "a point from 0 to " + std::to_string(static_cast<std::int64_t>(points) - 1),
                                           .next = "write the mesh again; this one is damaged"});
        }
    }
}

/// The corners of all triangles, grouped by point: corner 3 t + i belongs to triangles[t][i].
struct Corners {
    std::vector<std::int64_t> first;  ///< per point, and the total
    std::vector<std::int64_t> corner;
};

Corners group_corners(std::size_t points, Triangles triangles) {
    Corners corners{std::vector<std::int64_t>(points + 1), std::vector<std::int64_t>(3 * triangles.size())};
    for (const auto& triangle : triangles) {
        for (const std::int64_t point : triangle) ++corners.first[point + 1];
    }
    std::partial_sum(corners.first.begin(), corners.first.end(), corners.first.begin());
    std::vector<std::int64_t> next(corners.first.begin(), corners.first.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) corners.corner[next[triangles[t][i]]++] = static_cast<std::int64_t>(3 * t + i);
    }
    return corners;
}

/// An edge of the point at hand, as one of its corners sees it.
struct Spoke {
    std::int64_t other;   ///< the point at the far end
    bool leaves;          ///< the triangle runs from the point along this edge
    std::int64_t corner;  ///< which corner of the point (0, 1, ...)
};

/// The triangles around one point.
class PointFan {
public:
    void load(std::int64_t point, std::span<const std::int64_t> corners, Triangles triangles) {
        spokes_.clear();
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto& triangle = triangles[corners[i] / 3];
            const std::int64_t at = corners[i] % 3;
            const std::int64_t next = triangle[(at + 1) % 3], previous = triangle[(at + 2) % 3];
            if (next != point) spokes_.push_back({next, true, static_cast<std::int64_t>(i)});
            if (previous != point) spokes_.push_back({previous, false, static_cast<std::int64_t>(i)});
        }
        std::ranges::sort(spokes_,
                          [](const Spoke& a, const Spoke& b) { return a.other != b.other ? a.other < b.other : a.corner < b.corner; });
    }

    /// Calls visit(other, triangles, leaving) for every edge of the point.
    template <class Visit>
    void for_edges(Visit&& visit) const {
        for (std::size_t i = 0; i < spokes_.size();) {
            const std::size_t begin = i;
            std::int64_t leaving = 0;
            for (; i < spokes_.size() && spokes_[i].other == spokes_[begin].other; ++i) leaving += spokes_[i].leaves;
            visit(spokes_[begin].other, static_cast<std::int64_t>(i - begin), leaving);
        }
    }

    /// Do the triangles form one fan: no edge has more than two of them, and edges connect them all?
    [[nodiscard]] bool is_one_fan(std::size_t corners) {
        bool at_most_two = true;
        for_edges([&](std::int64_t, std::int64_t count, std::int64_t) { at_most_two = at_most_two && count <= 2; });
        if (!at_most_two) return false;
        UnionFind<std::size_t> articulation_points(corners);
        std::size_t count = corners;
        for (std::size_t i = 1; i < spokes_.size(); ++i) {
            if (spokes_[i].other != spokes_[i - 1].other) continue;
            const auto a = static_cast<std::size_t>(spokes_[i].corner), b = static_cast<std::size_t>(spokes_[i - 1].corner);
            if (articulation_points.find(a) == articulation_points.find(b)) continue;
            articulation_points.join(a, b);
            --count;
        }
        return count <= 1;
    }

private:
    std::vector<Spoke> spokes_;
};

bool has_zero_area(const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 a{q[0] - p[0], q[1] - p[1], q[2] - p[2]}, b{r[0] - p[0], r[1] - p[1], r[2] - p[2]};
    return a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2] && a[0] * b[1] == a[1] * b[0];
}

std::int64_t count_coincident(Points points) {
    std::vector<std::array<std::uint64_t, 3>> keys(points.size());  // equal coordinates have equal keys; NaN is ordered too
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) keys[i][axis] = ordered_bits(points[i][axis]);
    }
    std::ranges::sort(keys);
    std::int64_t count = 0;
    for (std::size_t i = 1; i < keys.size(); ++i) count += keys[i] == keys[i - 1];
    return count;
}

/// Euler number per component: points - edges + triangles, in order of the first point.
class ComponentEuler {
public:
    ComponentEuler(std::size_t points, Triangles triangles) : sets_(points), chi_(points) {
        for (const auto& triangle : triangles) {
            sets_.join(triangle[0], triangle[1]);
            sets_.join(triangle[0], triangle[2]);
        }
        for (const auto& triangle : triangles) ++chi_[sets_.find(triangle[0])];
    }
    void add(std::int64_t point, std::int64_t change) { chi_[sets_.find(point)] += change; }
    /// `used`: does a triangle use the point?
    template <class Used>
    std::vector<std::int64_t> list(Used&& used) {
        std::vector<std::int64_t> result;
        for (std::size_t i = 0; i < chi_.size(); ++i) {
            if (used(i) && sets_.find(static_cast<std::int64_t>(i)) == static_cast<std::int64_t>(i)) result.push_back(chi_[i]);
        }
        return result;
    }

private:
    UnionFind<std::int64_t> sets_;  // the root is the first point of its component
    std::vector<std::int64_t> chi_;
};

}  // namespace

SurfaceReport inspect(std::span<const std::array<double, 3>> points, std::span<const std::array<std::int64_t, 3>> triangles) {
    check_indices(points.size(), triangles);
    SurfaceReport report;
    report.points = static_cast<std::int64_t>(points.size());
    report.triangles = static_cast<std::int64_t>(triangles.size());
    const Corners corners = group_corners(points.size(), triangles);
    ComponentEuler euler(points.size(), triangles);
    PointFan articulation;
    for (std::int64_t point = 0; point < report.points; ++point) {
        const auto first = static_cast<std::size_t>(corners.first[point]), last = static_cast<std::size_t>(corners.first[point + 1]);
        if (first == last) {
            ++report.unused_points;
            continue;
        }
        articulation.load(point, std::span(corners.corner).subspan(first, last - first), triangles);
        euler.add(point, 1);
        articulation.for_edges([&](std::int64_t other, std::int64_t count, std::int64_t leaving) {
            if (other < point) return;  // seen from its other end
            ++report.edges;
            euler.add(point, -1);
            report.boundary_edges += count == 1;
            report.non_manifold_edges += count > 2;
            report.misoriented_edges += count == 2 && leaving != 1;
        });
        report.non_manifold_points += !articulation.is_one_fan(last - first);
    }
    for (const auto& triangle : triangles)
        report.zero_area_triangles += has_zero_area(points[triangle[0]], points[triangle[1]], points[triangle[2]]);
    report.coincident_points = count_coincident(points);
    report.component_chi = euler.list([&](std::size_t i) { return corners.first[i] != corners.first[i + 1]; });
    return report;
}

}  // namespace isoatlas
