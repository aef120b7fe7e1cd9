#include "methods/surfaces/triangle_index.h"

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

std::uint64_t TriangleIndex::key(const Index3& cell) {
    constexpr std::int64_t kMost = 1 << 20;  // cells along an axis, with some outside
    return static_cast<std::uint64_t>(cell[0] + kMost) << 42 | static_cast<std::uint64_t>(cell[1] + kMost) << 21 |
           static_cast<std::uint64_t>(cell[2] + kMost);
}

TriangleIndex::TriangleIndex(std::vector<Corners3> triangles) : triangles_(std::move(triangles)) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        Index3 low, high;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto [least, most] = std::minmax({triangles_[i][0][axis], triangles_[i][1][axis], triangles_[i][2][axis]});
            low[axis] = static_cast<std::int64_t>(std::floor(least)), high[axis] = static_cast<std::int64_t>(std::floor(most));
        }
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
            for (std::int64_t y = low[1]; y <= high[1]; ++y) {
                for (std::int64_t x = low[0]; x <= high[0]; ++x) in_cell_[key({x, y, z})].push_back(static_cast<std::uint32_t>(i));
            }
        }
    }
}

double TriangleIndex::distance(const Vec3& point, double max) const {
    Index3 middle;
    double inside = 1;  // distance to the nearest wall of its cell
    for (std::size_t axis = 0; axis < 3; ++axis) {
        middle[axis] = static_cast<std::int64_t>(std::floor(point[axis]));
        const double part = point[axis] - std::floor(point[axis]);
        inside = std::min({inside, part, 1 - part});
    }
    double nearest = max;
    for (std::int64_t radius = 0; static_cast<double>(radius - 1) + inside < nearest; ++radius) {
        for (std::int64_t z = -radius; z <= radius; ++z) {
            for (std::int64_t y = -radius; y <= radius; ++y) {
                const bool is_whole = std::abs(z) == radius || std::abs(y) == radius;
                for (std::int64_t x = -radius; x <= radius; x += is_whole ? 1 : std::max<std::int64_t>(1, 2 * radius)) {
                    const auto list = in_cell_.find(key({middle[0] + x, middle[1] + y, middle[2] + z}));
                    if (list == in_cell_.end()) continue;
                    for (const std::uint32_t i : list->second) nearest = std::min(nearest, distance_to_triangle(point, triangles_[i]));
                }
            }
        }
    }
    return nearest;
}

}  // namespace isoatlas
