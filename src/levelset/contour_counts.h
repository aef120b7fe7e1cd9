// Numbers of hits and loops of each contour: its Euler number, hence its genus.
#pragma once

#include "field/sample_grid.h"
#include "levelset/components.h"

namespace isoatlas {

struct ContourCounts {
    IdArray<ContourNumber, std::int64_t> hits, loops;  ///< 2D: loops stays 0
    std::int64_t active_cells = 0;

    /// Hits are the vertices, loops the faces; every hit has four face segments, each with two ends.
    [[nodiscard]] std::int64_t chi(ContourNumber contour) const { return loops[contour] - hits[contour]; }
};

/// Counts over all active cells, padding cells included. A tunnel turns two loops of a contour into one annulus: two faces less. Throws
/// Error{internal} when a loop does not separate the object and the low component of a contour. Cost: O(volume / 64) plus O(active cells).
[[nodiscard]] ContourCounts count_contours(const SampleView& volume, double tau, double tunnel_height, const HighBits& high,
                                           const Components& components, const Context& context);

}  // namespace isoatlas
