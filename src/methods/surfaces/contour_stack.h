// Contours of slices, connected (section 3.1): a surface from closed polygons in planes.
//
// A polygon is connected with each polygon of the next slice that turns the same way and overlaps it: a corner of one lies in the other.
// One with one gives a strip; where one meets several, each of them gets a strip of its own, and edges have more than two triangles:
// branches are what the method does not solve. Where objects begin and end the surface stays open. In the literature: as tiling.h.
#pragma once

#include "isoatlas/surface_methods.h"

namespace isoatlas {

/// Triangles are counter-clockwise seen from the Lows, in voxel coordinates that are right-handed.
class ConnectedContours final : public Extractor {
public:
    explicit ConnectedContours(const Volume& volume) : volume_(volume) {}
    Extraction extract(double tau, const Context& context) const override;

private:
    const Volume& volume_;
};

}  // namespace isoatlas
