// How near two contours of a surface come to each other: every pair of their triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/contours.h"
#include "geometry/triangles.h"
#include "geometry/vectors.h"
#include "isoatlas/surface.h"

namespace oracle {

using isoatlas::Vec3;
using Corners = std::array<Vec3, 3>;

/// The squared distance of two segments: at an end of one of them, or between the feet of their common perpendicular.
inline double squared_segment_distance(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    using isoatlas::dot, isoatlas::minus, isoatlas::squared_distance;
    double least =
        std::min({squared_distance(p, r, s, s), squared_distance(q, r, s, s), squared_distance(r, p, q, q), squared_distance(s, p, q, q)});
    const Vec3 u = minus(q, p), v = minus(s, r), w = minus(p, r);
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w), area = uu * vv - uv * uv;
    if (!(area > 0)) return least;
    const double a = (uv * vw - vv * uw) / area, b = (uu * vw - uv * uw) / area;
    if (a < 0 || a > 1 || b < 0 || b > 1) return least;
    Vec3 between{};
    for (std::size_t axis = 0; axis < 3; ++axis) between[axis] = w[axis] + a * u[axis] - b * v[axis];
    return std::min(least, dot(between, between));
}

/// Of triangles that do not meet: at a corner of one of them, or between two sides.
inline double squared_triangle_distance(const Corners& a, const Corners& b) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        least = std::min({least, isoatlas::squared_distance(a[i], b[0], b[1], b[2]), isoatlas::squared_distance(b[i], a[0], a[1], a[2])});
        for (std::size_t j = 0; j < 3; ++j) least = std::min(least, squared_segment_distance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
    }
    return least;
}

/// Infinity: it has one contour at most.
inline double least_gap(const isoatlas::Surface& surface) {
    using isoatlas::minus, isoatlas::norm;
    struct Ball {
        Corners corners;
        Vec3 centre;
        double radius;
        std::int64_t contour;
    };
    const isoatlas::MeshContours contours = isoatlas::find_contours({surface.points, surface.triangles});
    std::vector<Ball> balls;
    for (const auto& [a, b, c] : surface.triangles) {
        const Corners corners{surface.points[a], surface.points[b], surface.points[c]};
        Vec3 centre{};
        for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] = (corners[0][axis] + corners[1][axis] + corners[2][axis]) / 3;
        double radius = 0;
        for (const Vec3& corner : corners) radius = std::max(radius, norm(minus(corner, centre)));
        balls.push_back({corners, centre, radius, contours.contour_of[static_cast<std::size_t>(a)]});
    }
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < balls.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const Ball &one = balls[i], &other = balls[k];
            if (one.contour == other.contour || norm(minus(one.centre, other.centre)) - one.radius - other.radius > gap) continue;
            gap = std::min(gap, std::sqrt(squared_triangle_distance(one.corners, other.corners)));
        }
    }
    return gap;
}

}  // namespace oracle
