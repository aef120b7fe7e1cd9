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

void PhysicalMap::to_points(std::size_t count, Lanes<double>& voxel) const {
    if (rectilinear_) {
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 point = to_physical(geometry_, {voxel[0][i], voxel[1][i], voxel[2][i]});
            for (std::size_t axis = 0; axis < 3; ++axis) voxel[axis][i] = point[axis];
        }
        return;
    }
    const Lanes<double> from = voxel;
    for (std::size_t row = 0; row < 3; ++row) {
        const Vec3 m = matrix_[row];
        const double origin = geometry_.origin[row];
        for (std::size_t i = 0; i < count; ++i) voxel[row][i] = origin + (m[0] * from[0][i] + m[1] * from[1][i] + m[2] * from[2][i]);
    }
}

template <class Real>
void PhysicalMap::to_normals(std::size_t count, Lanes<Real>& slope, std::array<bool, kLanes>& rare) const {
    Lanes<Real> g;
    std::array<Real, kLanes> squared;
    for (std::size_t row = 0; row < 3; ++row) {
        const auto a = static_cast<Real>(normals_[row][0]), b = static_cast<Real>(normals_[row][1]),
                   c = static_cast<Real>(normals_[row][2]);
        for (std::size_t i = 0; i < count; ++i) g[row][i] = a * slope[0][i] + b * slope[1][i] + c * slope[2][i];
    }
    for (std::size_t i = 0; i < count; ++i) squared[i] = g[0][i] * g[0][i] + g[1][i] * g[1][i] + g[2][i] * g[2][i];
    for (std::size_t i = 0; i < count; ++i) rare[i] = is_rare(squared[i]);
    for (std::size_t i = 0; i < count; ++i) squared[i] = Real(-1) / std::sqrt(squared[i]);
    for (std::size_t i = 0; i < count; ++i) {
        if (rare[i]) continue;
        for (std::size_t row = 0; row < 3; ++row) slope[row][i] = g[row][i] * squared[i];
    }
}

template void PhysicalMap::to_normals<float>(std::size_t, Lanes<float>&, std::array<bool, kLanes>&) const;
template void PhysicalMap::to_normals<double>(std::size_t, Lanes<double>&, std::array<bool, kLanes>&) const;

std::array<float, 3> PhysicalMap::rare_normal(Vec3 slope, int axis, double sign) const {
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
