// The loop of a leaf: where the surface leaves a coalescible block, as hits and straight segments in its faces.
//
// A face has the segments of the smallest leaves on both of its sides. Hits stay where the exact surface has them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "octree_front/front_leaves.h"

namespace isoatlas {

/// An edge of the grid that the surface crosses.
struct EdgeHit {
    Index3 position;  ///< of its first end
    int axis;
    friend bool operator==(const EdgeHit&, const EdgeHit&) = default;
};

/// The hit on edge e (field/cell.h) of a coalescible block, or of a cell: there is one if the ends of the edge are of different classes.
/// Cost: O(level).
[[nodiscard]] EdgeHit hit_on_edge(const CoalescibleBlocks& blocks, int level, const Index3& block, int edge);

/// The loop of a leaf of level 1 or more, counter-clockwise seen from the Lows, as those of a cell (field/cell_loops.h). hits is emptied
/// first. Cost: O(segments).
void find_loop(const FrontLeaves& leaves, const FrontLeaf& leaf, std::vector<EdgeHit>& hits);

/// A hit inside a leaf of level 1 or more, near the middle of its loop; none where the line of the grid through there has none.
[[nodiscard]] std::optional<EdgeHit> hit_inside(const CoalescibleBlocks& blocks, const FrontLeaf& leaf, const std::vector<EdgeHit>& loop);

}  // namespace isoatlas
