#include "methods/surfaces/triangle_distance.h"

#include <cmath>

#include "geometry/triangles.h"

namespace isoatlas {

double area_of(const Corners3& triangle) {
    const Vec3 a = minus(triangle[1], triangle[0]), b = minus(triangle[2], triangle[0]);
    return std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]) / 2;
}

double distance_to_triangle(const Vec3& point, const Corners3& triangle) {
    return std::sqrt(nearest_point(point, triangle).squared_distance);
}

}  // namespace isoatlas
