// LeafDeviation: how far the hits of the exact surface in a leaf are from the fan that is drawn instead.
#pragma once

#include <span>

#include "field/sample_grid.h"
#include "octree_front/leaf_loop.h"

namespace isoatlas {

template <class T>
class LeafDeviation {
public:
    LeafDeviation(const SampleGrid<T>& grid, double tau, const CoalescibleBlocks& blocks) : grid_(grid), tau_(tau), blocks_(blocks) {}

    /// In voxels. centre: axis -1: the mean of the loop. Cost: O(hits in the leaf x hits of its loop).
    [[nodiscard]] double operator()(const FrontLeaf& leaf, std::span<const EdgeHit> loop, const EdgeHit& centre) const;

private:
    [[nodiscard]] Vec3 place_of(const EdgeHit& hit) const;

    SampleGrid<T> grid_;
    double tau_;
    const CoalescibleBlocks& blocks_;
};

}  // namespace isoatlas
