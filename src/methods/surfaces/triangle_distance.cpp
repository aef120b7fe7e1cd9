#include "methods/surfaces/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace isoatlas {
namespace {

Vec3 minus(const Vec3& p, const Vec3& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
double dot(const Vec3& p, const Vec3& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
Vec3 cross(const Vec3& p, const Vec3& q) { return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]}; }

double distance_to_segment(const Vec3& point, const Vec3& from, const Vec3& to) {
    const Vec3 along = minus(to, from), there = minus(point, from);
    const double square = dot(along, along);
    const double part = square > 0 ? std::clamp(dot(there, along) / square, 0.0, 1.0) : 0;
    return std::hypot(there[0] - part * along[0], there[1] - part * along[1], there[2] - part * along[2]);
}

}  // namespace

double area_of(const Corners3& triangle) {
    const Vec3 normal = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]));
    return std::hypot(normal[0], normal[1], normal[2]) / 2;
}

double distance_to_triangle(const Vec3& point, const Corners3& triangle) {
    const Vec3 normal = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]));
    const double size = std::sqrt(dot(normal, normal));
    bool is_over = size > 0;  // does it project into the triangle?
    double nearest = HUGE_VAL;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &from = triangle[i], &to = triangle[(i + 1) % 3];
        nearest = std::min(nearest, distance_to_segment(point, from, to));
        is_over = is_over && dot(cross(minus(to, from), minus(point, from)), normal) >= 0;
    }
    return is_over ? std::min(nearest, std::abs(dot(minus(point, triangle[0]), normal)) / size) : nearest;
}

}  // namespace isoatlas
