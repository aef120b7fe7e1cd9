// VoxelPositions: from physical points to voxel coordinates, the inverse of to_physical().
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

/// The geometry is borrowed.
class VoxelPositions {
public:
    explicit VoxelPositions(const Geometry& geometry) : geometry_(geometry) {
        const Mat3& m = geometry.direction;
        for (std::size_t axis = 0; axis < 3; ++axis) {  // rows of cofactors: the inverse is their transpose over the determinant
            const std::size_t p = (axis + 1) % 3, q = (axis + 2) % 3;
            for (std::size_t row = 0; row < 3; ++row) {
                const std::size_t r = (row + 1) % 3, t = (row + 2) % 3;
                inverse_[axis][row] = m[r][p] * m[t][q] - m[r][q] * m[t][p];
            }
        }
        determinant_ = m[0][0] * inverse_[0][0] + m[1][0] * inverse_[0][1] + m[2][0] * inverse_[0][2];
    }
    /// Do the axes span space?
    [[nodiscard]] bool is_unique() const { return determinant_ != 0; }
    [[nodiscard]] Vec3 of(const Vec3& physical) const {
        Vec3 voxel;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double along = 0;
            for (std::size_t row = 0; row < 3; ++row) along += inverse_[axis][row] * (physical[row] - geometry_.origin[row]) / determinant_;
            const std::vector<double>& coordinates = geometry_.coordinates[axis];
            if (coordinates.size() < 2)
                voxel[axis] = (along - (coordinates.empty() ? 0 : coordinates.front())) / geometry_.spacing[axis];
            else
                voxel[axis] = between(coordinates, along);
        }
        return voxel;
    }

private:
    /// coordinates: ascending.
    static double between(const std::vector<double>& coordinates, double along) {
        const auto behind = std::upper_bound(coordinates.begin() + 1, coordinates.end() - 1, along);
        const double from = *(behind - 1);
        return static_cast<double>(behind - 1 - coordinates.begin()) + (along - from) / (*behind - from);
    }

    const Geometry& geometry_;
    Mat3 inverse_{};
    double determinant_;
};

/// The grid with even steps along every axis, the smallest of the axis: its positions are an affine map of space, under which triangles
/// stay flat.
[[nodiscard]] inline Geometry with_smallest_steps(Geometry geometry) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::vector<double>& along = geometry.coordinates[axis];
        if (along.size() < 2) continue;
        double least = along[1] - along[0];
        for (std::size_t i = 2; i < along.size(); ++i) least = std::min(least, along[i] - along[i - 1]);
        geometry.spacing[axis] = least;
    }
    geometry.coordinates = {};
    return geometry;
}

}  // namespace isoatlas
