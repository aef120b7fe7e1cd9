#include "preview/sample_surface.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "base/big_vector.h"
#include "base/parallel.h"
#include "base/systematic_sample.h"
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

void set_point(const Surface& surface, const TriangleCorners& corners, std::int64_t k, PointCloud& cloud) {
    const std::array<double, 3> weights = weights_of(k);
    Vec3 point{}, normal{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            point[axis] += weights[i] * surface.points[corners[i]][axis];
            normal[axis] += weights[i] * static_cast<double>(surface.normals[corners[i]][axis]);
        }
    }
    if (!(norm(normal) > 0)) normal = normal_of(surface, corners);  // those of the corners cancel
    const double length = norm(normal);
    cloud.points[k] = point;
    cloud.normals[k] = {static_cast<float>(normal[0] / length), static_cast<float>(normal[1] / length),
                        static_cast<float>(normal[2] / length)};
}

}  // namespace

SurfaceSample sample_surface(const Surface& surface, std::int64_t points, const Context& context) {
    const std::int64_t triangles = std::ssize(surface.triangles);
    BigVector<double> areas;
    resize_for_overwrite(areas, static_cast<std::size_t>(triangles));
    for_each_index(context.threads, areas.size(), [&](std::size_t t) { areas[t] = norm(normal_of(surface, surface.triangles[t])) / 2; });
    const SystematicSample chosen(triangles, context.threads, [&](std::int64_t t) { return areas[t]; });

    SurfaceSample sample;
    if (!(chosen.total() > 0) || points <= 0) return sample;
    const double part = chosen.total() / static_cast<double>(points);
    sample.spacing = std::sqrt(part);
    sample.cloud.points.resize(chosen.count(part));
    sample.cloud.normals.resize(chosen.count(part));
    chosen.for_each(part, [&](std::int64_t t, std::int64_t k) { set_point(surface, surface.triangles[t], k, sample.cloud); });
    return sample;
}

}  // namespace isoatlas
