#include "preview/sample_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/big_vector.h"
#include "base/parallel.h"
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

/// How many of the points, each in the middle of its part of the area, lie before this one.
std::int64_t points_before(double area, double part, std::int64_t points) {
    std::int64_t count = std::clamp(static_cast<std::int64_t>(area / part) - 1, std::int64_t{0}, points);
    while (count < points && (static_cast<double>(count) + 0.5) * part < area) ++count;
    return count;
}

}  // namespace

SurfaceSample sample_surface(const Surface& surface, std::int64_t points, const Context& context) {
    constexpr std::int64_t kTriangles = 4096;  // of a piece
    const std::int64_t triangles = std::ssize(surface.triangles), pieces = (triangles + kTriangles - 1) / kTriangles;
    BigVector<double> areas;
    resize_for_overwrite(areas, static_cast<std::size_t>(triangles));
    std::vector<double> before(static_cast<std::size_t>(pieces) + 1);  // the area before each piece
    const auto last_of = [&](std::int64_t piece) { return std::min((piece + 1) * kTriangles, triangles); };
    for_each_block(context.threads, pieces, [&](std::int64_t piece) {
        double area = 0;
        for (std::int64_t t = piece * kTriangles; t < last_of(piece); ++t)
            area += areas[t] = norm(normal_of(surface, surface.triangles[t])) / 2;
        before[piece + 1] = area;
    });
    for (std::int64_t piece = 0; piece < pieces; ++piece) before[piece + 1] += before[piece];

    SurfaceSample sample;
    if (!(before.back() > 0) || points <= 0) return sample;
    const double part = before.back() / static_cast<double>(points);
    sample.spacing = std::sqrt(part);
    const std::int64_t count = points_before(before.back(), part, points);
    sample.cloud.points.resize(count);
    sample.cloud.normals.resize(count);
    for_each_block(context.threads, pieces, [&](std::int64_t piece) {
        double area = 0;  // the same sums as above: a piece ends where the next one begins
        std::int64_t next = points_before(before[piece], part, points);
        for (std::int64_t t = piece * kTriangles; t < last_of(piece); ++t) {
            area += areas[t];
            for (; next < count && (static_cast<double>(next) + 0.5) * part < before[piece] + area; ++next)
                set_point(surface, surface.triangles[t], next, sample.cloud);
        }
    });
    return sample;
}

}  // namespace isoatlas
