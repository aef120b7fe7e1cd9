// Handles: from which isovalue to which does a tunnel live?
//
// Going down, an element that joins a contour with itself opens a tunnel, one that fills a hole closes one. Both are exact, and so is how
// many tunnels each contour has at every isovalue. Which of the open tunnels is closed is not told by the trees: here the one that was
// opened last, along the contour and all that it merges into. So the number of handles and the sum of their persistence are exact,
// *individual pairs are approximate* (exact ones need the homology of the volume: essential.md section 4).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isoatlas/analysis.h"

namespace isoatlas {

/// A tunnel for tau in (closes, opens]. Stored values; positions in voxel coordinates.
struct Handle {
    double opens, closes;
    std::array<double, 3> opened_at, closed_at;
    std::int64_t event;  ///< at which it opens, of the object whose tunnel it is then
    [[nodiscard]] double persistence() const { return opens - closes; }
};

/// By descending persistence, then ascending element that opens it; those of at least that persistence, which is above 0. 2D: none, holes
/// are contours there. Cost: O(elements log^2 elements).
[[nodiscard]] std::vector<Handle> pair_handles(const Analysis& analysis, double least_persistence = 0);

}  // namespace isoatlas
