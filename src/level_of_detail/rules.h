// The state of a surface while it is simplified, which all its blocks share: they change different elements of it.
#pragma once

#include <cstdint>

#include "isoatlas/array.h"
#include "level_of_detail/collapsible_mesh.h"
#include "level_of_detail/quadric.h"
#include "level_of_detail/surface_frame.h"
#include "level_of_detail/tracked_pieces.h"

namespace isoatlas {

/// How far the present triangles and the original ones are from each other. `original` of null: there is no bound.
struct DistanceState {
    const OriginalSurface* original = nullptr;
    double max = 0;
    Array<float> to_original;  ///< of a present triangle: its points are at most so far from the original surface
    TrackedPieces tracked;
};

struct SurfaceState {
    CollapsibleMesh mesh;
    const SurfaceFrame* frame;
    Array<Vec3> scaled;              ///< the points where distances are measured
    Array<Vec3> points;              ///< the same in physical coordinates, for exact predicates
    Array<Quadric<float>> quadrics;  ///< of each point
    Array<std::uint16_t> faces;      ///< of a point: the planes in which it stays, a bit each
    Array<std::uint8_t> locked;      ///< of a point: 1 where a triangle of it reaches into another block
    Array<std::uint8_t> failed;  ///< of a triangle: bit k where the edge of its corner k could not be collapsed and nothing changed since
    DistanceState distance;
};

/// Marks the points of edges with one triangle: kRim.
void mark_rims(const CollapsibleMesh& mesh, Array<std::uint16_t>& faces);
/// The quadric of a point: that of the triangles around it.
void set_quadric(SurfaceState& state, std::uint32_t point);

}  // namespace isoatlas
