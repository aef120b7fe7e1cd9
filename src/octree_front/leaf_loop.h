// The loop of a leaf: where the surface leaves a coalescible block, as hits and straight segments in its faces.
//
// A face has the segments of the smallest leaves on both of its sides. Hits stay where the exact surface has them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "octree_front/front_leaves.h"

namespace isoatlas {

/// An edge of the grid that the surface crosses.
struct EdgeHit {
    Index3 position;  ///< of its first end
    int axis;
    friend bool operator==(const EdgeHit&, const EdgeHit&) = default;
};

/// The hit on edge e (field/cell.h) of a leaf: there is one if the ends of the edge are of different classes. Cost: O(level).
[[nodiscard]] EdgeHit hit_on_edge(const CoalescibleBlocks& blocks, const FrontLeaf& leaf, int edge);

/// Appends the loop of a leaf of level 1 or more, counter-clockwise seen from the Lows, as those of a cell (field/cell_loops.h).
/// Cost: O(segments).
void add_loop(const FrontLeaves& leaves, const FrontLeaf& leaf, std::vector<EdgeHit>& hits);

/// A hit inside a leaf of level 1 or more, near the middle of its loop; none where the line of the grid through there has none.
[[nodiscard]] std::optional<EdgeHit> hit_inside(const CoalescibleBlocks& blocks, const FrontLeaf& leaf, std::span<const EdgeHit> loop);

}  // namespace isoatlas
