// Contours of slices, connected (section 3.1): a surface from closed polygons in planes.
//
// A polygon is connected with each polygon of the next slice that turns the same way and overlaps it: a corner of one lies in the other.
// One with one gives a strip; where one meets several, each of them gets a strip of its own, and edges have more than two triangles:
// branches are what the method does not solve. In noise, one polygon meets thousands: strips are made for the kMostBranches largest of each
// polygon, so that there are O(corners) triangles; else each of the thousands has a strip with all corners of the large one. Where objects
// begin and end the surface stays open. In the literature: as tiling.h.
#pragma once

#include <cstdint>

#include "isoatlas/surface_methods.h"

namespace isoatlas {

inline constexpr std::int64_t kMostBranches = 16;  ///< of a polygon, in a neighbouring slice

/// Triangles are counter-clockwise seen from the Lows, in voxel coordinates that are right-handed.
class ConnectedContours final : public Extractor {
public:
    explicit ConnectedContours(const Volume& volume) : volume_(volume) {}
    Extraction extract(double tau, const Context& context) const override;

private:
    const Volume& volume_;
};

}  // namespace isoatlas
