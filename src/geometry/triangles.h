// Triangles in space: where they meet, exactly, and how far a point is from one.
//
// Coordinates are finite. Exact: decided for the coordinates as they are, without tolerance, also where points lie on lines or in planes of
// others. No memory is allocated where doubles decide.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "geometry/orientation.h"

namespace isoatlas {

/// Do two triangles meet in more than these corners they share? No corner shared: in any point. One, s[0] and t[0]: in another point. Two,
/// s[0], t[0] and s[1], t[1]: are they folded onto each other. Of triangles with area exact; of others no crossing is missed, but touching
/// may count. Some 20 ns where doubles decide and the triangles are apart.
bool triangles_meet(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t, int shared);

/// Has every point of one a lower coordinate than every point of the other?
inline bool boxes_are_apart(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (std::max({s[0][i], s[1][i], s[2][i]}) < std::min({t[0][i], t[1][i], t[2][i]})) return true;
        if (std::max({t[0][i], t[1][i], t[2][i]}) < std::min({s[0][i], s[1][i], s[2][i]})) return true;
    }
    return false;
}

/// Do two triangles of a mesh meet in more than the corners that they share by index? The same three corners: always.
template <class Index>
bool triangles_cross(std::span<const Vec3> points, const std::array<Index, 3>& s, const std::array<Index, 3>& t) {
    std::array<Index, 3> p = s, q = t;
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = shared; j < 3; ++j)
            if (p[i] == q[j]) {
                std::swap(p[i], p[shared]);
                std::swap(q[j], q[shared]);
                ++shared;
                break;
            }
    if (shared == 3) return true;
    const auto corners = [&](const std::array<Index, 3>& of) {
        return std::array{points[static_cast<std::size_t>(of[0])], points[static_cast<std::size_t>(of[1])],
                          points[static_cast<std::size_t>(of[2])]};
    };
    const std::array<Vec3, 3> first = corners(p), second = corners(q);
    return !(shared == 0 && boxes_are_apart(first, second)) && triangles_meet(first, second, static_cast<int>(shared));
}

/// Closed and exact, as all below: ends, sides and corners belong to segments, triangles and tetrahedra, which may be flat.
bool segment_meets_triangle(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& triangle);
bool triangle_contains(const std::array<Vec3, 3>& triangle, const Vec3& p);
bool tetrahedron_contains(const std::array<Vec3, 4>& tetrahedron, const Vec3& p);

struct NearestPoint {
    Vec3 point;
    double squared_distance;
};

/// The point of a triangle that is nearest to p. In doubles, but never misled by slivers: a point of the triangle (within rounding) and its
/// distance from p, which is at most the sliver's height greater than the least. Some 20 ns.
NearestPoint nearest_point(const Vec3& p, const std::array<Vec3, 3>& triangle);

inline double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    return nearest_point(p, {a, b, c}).squared_distance;
}

}  // namespace isoatlas
