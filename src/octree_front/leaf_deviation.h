// LeafDeviation: how far the hits of the exact surface in a leaf are from the fan that is drawn instead.
#pragma once

#include <span>

#include "field/sample_grid.h"
#include "octree_front/leaf_loop.h"

namespace isoatlas {

/// Where leaves are in space.
struct PhysicalLeaves {
    const Geometry& geometry;
    Index3 origin;  ///< of the part of the volume whose leaves they are
    [[nodiscard]] Vec3 point(Vec3 voxel) const {
        for (std::size_t axis = 0; axis < 3; ++axis) voxel[axis] += static_cast<double>(origin[axis]);
        return to_physical(geometry, voxel);
    }
};

template <class T>
class LeafDeviation {
public:
    /// space: null: distances are in voxels.
    LeafDeviation(const SampleGrid<T>& grid, double tau, const CoalescibleBlocks& blocks, const PhysicalLeaves* space)
        : grid_(grid), tau_(tau), blocks_(blocks), space_(space) {}

    /// In voxels, or physical. centre: axis -1: the mean of the loop. Cost: O(hits in the leaf x hits of its loop).
    [[nodiscard]] double operator()(const FrontLeaf& leaf, std::span<const EdgeHit> loop, const EdgeHit& centre) const;

private:
    [[nodiscard]] Vec3 place_of(const EdgeHit& hit) const;

    SampleGrid<T> grid_;
    double tau_;
    const CoalescibleBlocks& blocks_;
    const PhysicalLeaves* space_;
};

}  // namespace isoatlas
