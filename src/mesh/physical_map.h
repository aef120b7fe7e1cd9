// From voxel positions and voxel differences to physical points and normals.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

class PhysicalMap {
public:
    /// Throws Error{usage} when the axes of the geometry do not span space.
    PhysicalMap(const Geometry& geometry, const Extent& extent);

    /// to_physical of the geometry; one matrix product unless the grid is rectilinear.
    [[nodiscard]] Vec3 point(const Vec3& voxel) const {
        if (rectilinear_) return to_physical(geometry_, voxel);
        Vec3 physical = geometry_.origin;
        for (int row = 0; row < 3; ++row) {
            physical[row] += matrix_[row][0] * voxel[0] + matrix_[row][1] * voxel[1] + matrix_[row][2] * voxel[2];
        }
        return physical;
    }

    /// 1 / (distance along the axis between the neighbours of sample i that exist); 0 when there is no neighbour.
    [[nodiscard]] const double* inverse_distance(int axis) const { return inverse_distance_[axis].data(); }

    /// Unit normal towards lower values. slope: change of the value per unit of length along each axis. When it is zero or not finite,
    /// the normal is that of a value that falls along `axis` in the direction `sign`.
    [[nodiscard]] std::array<float, 3> normal(const Vec3& slope, int axis, double sign) const;

private:
    const Geometry& geometry_;
    bool rectilinear_;
    Mat3 matrix_;   ///< voxel steps to physical steps
    Mat3 normals_;  ///< inverse transpose of the directions: slopes along the axes to the physical gradient
    std::array<std::vector<double>, 3> inverse_distance_;
};

}  // namespace isoatlas
