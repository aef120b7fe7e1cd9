#include "level_of_detail/normal_near.h"

#include <cmath>

#include "geometry/triangles.h"

namespace isoatlas {

std::array<float, 3> normal_near(const OriginalSurface& original, std::span<const std::array<float, 3>> normals, const Vec3& p,
                                 double step) {
    OriginalSurface::Nearest nearest{kNone, 0};
    for (double distance = step; nearest.triangle == kNone; distance *= 2) nearest = original.nearest(p, distance);
    const TrianglePoints corners = original.corners(nearest.triangle);
    const std::array<std::int64_t, 3>& points = original.triangle(nearest.triangle);
    const NearestPoint place = nearest_point(p, corners);
    Vec3 sum{};
    for (std::size_t k = 0; k < 3; ++k) {  // weights: areas opposite of the corners
        const Vec3 n = cross(minus(corners[(k + 1) % 3], place.point), minus(corners[(k + 2) % 3], place.point));
        const double weight = std::sqrt(dot(n, n)) + 1e-300;
        const std::array<float, 3>& normal = normals[static_cast<std::size_t>(points[k])];
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += weight * normal[axis];
    }
    const double length = std::sqrt(dot(sum, sum));
    if (!(length > 0)) return normals[static_cast<std::size_t>(points[0])];
    return {static_cast<float>(sum[0] / length), static_cast<float>(sum[1] / length), static_cast<float>(sum[2] / length)};
}

}  // namespace isoatlas
