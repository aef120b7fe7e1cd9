#include "preview/sample_surface.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/vectors.h"

namespace isoatlas {
namespace {

using TriangleCorners = std::array<std::int64_t, 3>;

/// Of the plane of a triangle; as long as twice its area.
Vec3 normal_of(const Surface& surface, const TriangleCorners& corners) {
    const Vec3& first = surface.points[corners[0]];
    return cross(minus(surface.points[corners[1]], first), minus(surface.points[corners[2]], first));
}

/// The k-th of evenly spread places in a triangle, as weights of its corners.
std::array<double, 3> weights_of(std::int64_t k) {
    constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;  // powers of the inverse of the plastic number
    double u = kFirst * static_cast<double>(k), v = kSecond * static_cast<double>(k);
    u -= std::floor(u), v -= std::floor(v);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    return {1 - u - v, u, v};
}

void add_point(const Surface& surface, const TriangleCorners& corners, const std::array<double, 3>& weights, PointCloud& cloud) {
    Vec3 point{}, normal{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            point[axis] += weights[i] * surface.points[corners[i]][axis];
            normal[axis] += weights[i] * static_cast<double>(surface.normals[corners[i]][axis]);
        }
    }
    if (!(norm(normal) > 0)) normal = normal_of(surface, corners);  // those of the corners cancel
    const double length = norm(normal);
    cloud.points.push_back(point);
    cloud.normals.push_back(
        {static_cast<float>(normal[0] / length), static_cast<float>(normal[1] / length), static_cast<float>(normal[2] / length)});
}

}  // namespace

SurfaceSample sample_surface(const Surface& surface, std::int64_t points) {
    double area = 0;
    for (const TriangleCorners& corners : surface.triangles) area += norm(normal_of(surface, corners)) / 2;
    SurfaceSample sample;
    if (!(area > 0) || points <= 0) return sample;
    const double part = area / static_cast<double>(points);
    sample.spacing = std::sqrt(part);
    double before = 0;
    std::int64_t next = 0;  // point, in the middle of its part
    for (const TriangleCorners& corners : surface.triangles) {
        before += norm(normal_of(surface, corners)) / 2;
        for (; next < points && (static_cast<double>(next) + 0.5) * part < before; ++next)
            add_point(surface, corners, weights_of(next), sample.cloud);
    }
    return sample;
}

}  // namespace isoatlas
