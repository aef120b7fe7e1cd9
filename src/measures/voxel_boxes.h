// The boxes of the voxels of a grid: each reaches half way to the neighbours; at the ends as far outwards as inwards.
#pragma once

#include <array>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

/// Along the axes of the grid, in the unit of length: a point lies at origin + direction * (places along the axes).
struct VoxelBoxes {
    std::array<std::vector<double>, 3> middle, width;  ///< of sample i of an axis. 2D: the third axis has the width 0
    Vec3 origin;
    Mat3 direction;
    double skew = 1;  ///< volume of a box by the product of its widths (2D: area); 1: the axes are orthogonal

    VoxelBoxes(const Geometry& geometry, const Extent& extent);
};

}  // namespace isoatlas
