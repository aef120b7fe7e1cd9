#include "geometry/triangles.h"

#include <optional>
#include <utility>

namespace isoatlas {
namespace {

using Triangle = std::array<Vec3, 3>;

Vec2 along_axis(const Vec3& p, std::size_t axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

/// An axis along which three points are seen as a triangle; none: they lie on a line.
std::optional<std::size_t> axis_that_shows(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = minus(b, a), v = minus(c, a);
    const std::array<double, 3> area{std::abs(u[1] * v[2] - u[2] * v[1]), std::abs(u[2] * v[0] - u[0] * v[2]),
                                     std::abs(u[0] * v[1] - u[1] * v[0])};
    const auto widest = static_cast<std::size_t>(std::max_element(area.begin(), area.end()) - area.begin());
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t axis = (widest + i) % 3;
        if (orientation(along_axis(a, axis), along_axis(b, axis), along_axis(c, axis)) != 0) return axis;
    }
    return std::nullopt;
}

// Points of a line in space and in the plane are in the order of their coordinates.
template <class Point>
bool meet_on_a_line(const Point& p, const Point& q, const Point& r, const Point& s) {
    return std::max(std::min(p, q), std::min(r, s)) <= std::min(std::max(p, q), std::max(r, s));
}

bool segments_meet(const Vec2& p, const Vec2& q, const Vec2& r, const Vec2& s) {
    const int of_r = orientation(p, q, r), of_s = orientation(p, q, s);
    if (of_r * of_s > 0) return false;
    const int of_p = orientation(r, s, p), of_q = orientation(r, s, q);
    if (of_p * of_q > 0) return false;
    if (of_r != 0 || of_s != 0 || of_p != 0 || of_q != 0) return true;
    return meet_on_a_line(p, q, r, s);
}

bool segments_meet(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    if (orientation(p, q, r, s) != 0) return false;
    std::optional<std::size_t> axis = axis_that_shows(p, q, r);
    if (!axis) axis = axis_that_shows(p, q, s);
    if (!axis) axis = axis_that_shows(r, s, p);
    if (!axis) axis = axis_that_shows(r, s, q);
    if (!axis) return meet_on_a_line(p, q, r, s);
    return segments_meet(along_axis(p, *axis), along_axis(q, *axis), along_axis(r, *axis), along_axis(s, *axis));
}

/// Of a triangle with area.
bool contains(const std::array<Vec2, 3>& t, const Vec2& p) {
    const int a = orientation(t[0], t[1], p), b = orientation(t[1], t[2], p), c = orientation(t[2], t[0], p);
    return std::min({a, b, c}) >= 0 || std::max({a, b, c}) <= 0;
}

bool meets_in_the_plane(const Vec3& p, const Vec3& q, const Triangle& triangle, std::size_t axis) {
    std::array<Vec2, 3> t;
    for (std::size_t i = 0; i < 3; ++i) t[i] = along_axis(triangle[i], axis);
    const Vec2 first = along_axis(p, axis), second = along_axis(q, axis);
    return contains(t, first) || segments_meet(first, second, t[0], t[1]) || segments_meet(first, second, t[1], t[2]) ||
           segments_meet(first, second, t[2], t[0]);
}

/// The triangle is that line or point.
bool meets_sides(const Vec3& p, const Vec3& q, const Triangle& t) {
    return segments_meet(p, q, t[0], t[1]) || segments_meet(p, q, t[1], t[2]) || segments_meet(p, q, t[2], t[0]);
}

/// Where the plane of the triangle does not contain both ends and does not have them on one side.
bool line_meets_triangle(const Vec3& p, const Vec3& q, const Triangle& t) {
    const int a = orientation(p, q, t[0], t[1]), b = orientation(p, q, t[1], t[2]);
    if (a * b < 0) return false;
    const int c = orientation(p, q, t[2], t[0]);
    return a * c >= 0 && b * c >= 0;
}

/// The ends lie on these sides of the plane of the triangle.
bool segment_meets(const Vec3& p, const Vec3& q, int side_of_p, int side_of_q, const Triangle& t) {
    if (side_of_p * side_of_q > 0) return false;
    if (side_of_p != 0 || side_of_q != 0) return line_meets_triangle(p, q, t);
    const std::optional<std::size_t> axis = axis_that_shows(t[0], t[1], t[2]);
    return axis ? meets_in_the_plane(p, q, t, *axis) : meets_sides(p, q, t);
}

int side_of(const Triangle& t, const Vec3& p) { return orientation(t[0], t[1], t[2], p); }

/// Is a side of t somewhere in s? sides: of the corners of t, of the plane of s.
bool a_side_meets(const Triangle& s, const Triangle& t, const std::array<int, 3>& sides) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if (segment_meets(t[i], t[next], sides[i], sides[next], s)) return true;
    }
    return false;
}

bool any_point_common(const Triangle& s, const Triangle& t) {
    const std::array<int, 3> of_t{side_of(s, t[0]), side_of(s, t[1]), side_of(s, t[2])};
    if (of_t[0] == of_t[1] && of_t[1] == of_t[2] && of_t[0] != 0) return false;
    const std::array<int, 3> of_s{side_of(t, s[0]), side_of(t, s[1]), side_of(t, s[2])};
    if (of_s[0] == of_s[1] && of_s[1] == of_s[2] && of_s[0] != 0) return false;
    return a_side_meets(s, t, of_t) || a_side_meets(t, s, of_s);  // what is common is empty, or ends on a side of one of them
}

/// s[0] is t[0]. A ray from there through another common point leaves one of both first, across from the shared corner.
bool point_beyond_corner_common(const Triangle& s, const Triangle& t) {
    const int of_t1 = side_of(s, t[1]), of_t2 = side_of(s, t[2]);
    if (of_t1 * of_t2 > 0) return false;
    const int of_s1 = side_of(t, s[1]), of_s2 = side_of(t, s[2]);
    if (of_s1 * of_s2 > 0) return false;
    return segment_meets(t[1], t[2], of_t1, of_t2, s) || segment_meets(s[1], s[2], of_s1, of_s2, t);
}

/// s[0] is t[0], s[1] is t[1].
bool is_folded(const Triangle& s, const Triangle& t) {
    const int quick = quick_orientation(s[0], s[1], s[2], t[2]);
    if (quick != kUnsure) return false;
    std::optional<std::size_t> axis = axis_that_shows(s[0], s[1], s[2]);
    if (!axis) return !axis_that_shows(t[0], t[1], t[2]);
    const auto turn = [&](const Vec3& p) { return orientation(along_axis(s[0], *axis), along_axis(s[1], *axis), along_axis(p, *axis)); };
    return turn(s[2]) * turn(t[2]) > 0 && exact_orientation(s[0], s[1], s[2], t[2]) == 0;
}

Vec3 between(const Vec3& a, const Vec3& step, double part) { return {a[0] + part * step[0], a[1] + part * step[1], a[2] + part * step[2]}; }

/// Of a segment, to the origin.
Vec3 nearest_to_origin(const Vec3& a, const Vec3& b) {
    const Vec3 step = minus(b, a);
    const double length = dot(step, step), along = -dot(a, step);
    if (!(along > 0)) return a;
    return along >= length ? b : between(a, step, along / length);
}

}  // namespace

bool triangles_meet(const Triangle& s, const Triangle& t, int shared) {
    return shared == 0 ? any_point_common(s, t) : shared == 1 ? point_beyond_corner_common(s, t) : is_folded(s, t);
}

bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Triangle& triangle) {
    return segment_meets(p, q, side_of(triangle, p), side_of(triangle, q), triangle);
}

bool triangle_contains(const Triangle& triangle, const Vec3& p) { return segment_meets_triangle(p, p, triangle); }

bool tetrahedron_contains(const std::array<Vec3, 4>& t, const Vec3& p) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (p[i] < std::min({t[0][i], t[1][i], t[2][i], t[3][i]}) || p[i] > std::max({t[0][i], t[1][i], t[2][i], t[3][i]})) return false;
    }
    const int whole = orientation(t[0], t[1], t[2], t[3]);
    if (whole == 0)  // a flat one is its four sides
        return triangle_contains({t[0], t[1], t[2]}, p) || triangle_contains({t[0], t[1], t[3]}, p) ||
               triangle_contains({t[0], t[2], t[3]}, p) || triangle_contains({t[1], t[2], t[3]}, p);
    return orientation(t[0], t[1], t[2], p) != -whole && orientation(t[0], t[1], p, t[3]) != -whole &&
           orientation(t[0], p, t[2], t[3]) != -whole && orientation(p, t[1], t[2], t[3]) != -whole;
}

NearestPoint nearest_point(const Vec3& p, const Triangle& triangle) {
    const Vec3 a = minus(triangle[0], p), b = minus(triangle[1], p), c = minus(triangle[2], p);
    Vec3 nearest = nearest_to_origin(a, b);
    double least = dot(nearest, nearest);
    const auto offer = [&](const Vec3& point) {
        const double squared = dot(point, point);
        if (squared < least) least = squared, nearest = point;
    };
    offer(nearest_to_origin(b, c));
    offer(nearest_to_origin(c, a));
    const Vec3 ab = minus(b, a), ac = minus(c, a), normal = cross(ab, ac);
    const double area = dot(normal, normal);
    const double to_b = -dot(cross(a, ac), normal), to_c = -dot(cross(ab, a), normal);  // coordinates of the foot, times area
    if (area > 0 && to_b > 0 && to_c > 0 && to_b + to_c < area) offer(between(between(a, ab, to_b / area), ac, to_c / area));
    return {{p[0] + nearest[0], p[1] + nearest[1], p[2] + nearest[2]}, least};
}

}  // namespace isoatlas
