#include "mesh/physical_map.h"

#include <algorithm>
#include <cmath>

namespace isoatlas {
namespace {

/// Rows of cofactors divided by the determinant: the inverse transpose.
Mat3 inverse_transpose(const Mat3& m) {
    Mat3 result{};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            result[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    }
    const double determinant = m[0][0] * result[0][0] + m[0][1] * result[0][1] + m[0][2] * result[0][2];
    if (!(std::abs(determinant) > 1e-12)) {
        throw Error(ErrorKind::usage, {.where = "direction matrix",
                                       .what = "the axes of the volume do not span space",
                                       .expected = "three independent directions",
                                       .next = "correct the geometry of the volume"});
    }
    for (Vec3& row : result) {
        for (double& entry : row) entry /= determinant;
    }
    return result;
}

std::vector<double> inverse_distances(const Geometry& geometry, int axis, std::int64_t size) {
    const std::vector<double>& coordinates = geometry.coordinates[axis];
    std::vector<double> inverse(static_cast<std::size_t>(size));
    for (std::int64_t i = 0; i < size; ++i) {
        const std::int64_t low = std::max<std::int64_t>(i - 1, 0), high = std::min(i + 1, size - 1);
        const double distance =
            coordinates.size() > 1 ? coordinates[high] - coordinates[low] : geometry.spacing[axis] * static_cast<double>(high - low);
        inverse[i] = low == high ? 0 : 1 / distance;
    }
    return inverse;
}

Vec3 multiply(const Mat3& m, const Vec3& v) {
    Vec3 result;
    for (int row = 0; row < 3; ++row) result[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
    return result;
}

}  // namespace

PhysicalMap::PhysicalMap(const Geometry& geometry, const Extent& extent)
    : geometry_(geometry),
      rectilinear_(std::ranges::any_of(geometry.coordinates, [](const auto& axis) { return !axis.empty(); })),
      matrix_(geometry.direction),
      normals_(inverse_transpose(geometry.direction)) {
    for (Vec3& row : matrix_) {
        for (int axis = 0; axis < 3; ++axis) row[axis] *= geometry.spacing[axis];
    }
    for (int axis = 0; axis < 3; ++axis) inverse_distance_[axis] = inverse_distances(geometry, axis, extent.size[axis]);
}

void PhysicalMap::to_points_one_by_one(std::size_t count, Lanes<double>& voxel) const {
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 point = to_physical(geometry_, {voxel[0][i], voxel[1][i], voxel[2][i]});
        for (std::size_t axis = 0; axis < 3; ++axis) voxel[axis][i] = point[axis];
    }
}

std::array<float, 3> PhysicalMap::degenerate_normal(Vec3 slope, int axis, double sign) const {
    const double largest = std::max({std::abs(slope[0]), std::abs(slope[1]), std::abs(slope[2])});
    if (largest > 0 && std::isfinite(largest) && std::isfinite(slope[0] + slope[1] + slope[2])) {
        for (double& s : slope) s /= largest;
    } else {
        slope = {};
        slope[axis] = -sign;
    }
    const Vec3 gradient = multiply(normals_, slope);
    const double scale = -1 / std::hypot(gradient[0], gradient[1], gradient[2]);
    return {static_cast<float>(gradient[0] * scale), static_cast<float>(gradient[1] * scale), static_cast<float>(gradient[2] * scale)};
}

}  // namespace isoatlas
