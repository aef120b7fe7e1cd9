// Size and cost of a surface, before anything of it is read.
#include <algorithm>
#include <cmath>

#include "atlas/access.h"
#include "bricks/stored_samples.h"
#include "census/level_census.h"
#include "isoatlas/atlas.h"
#include "isoatlas/environment.h"

namespace isoatlas {
namespace {

Bounds bounds(std::int64_t min, std::int64_t max) { return {min, max}; }

}  // namespace

// Triangles: three edges each, every edge shared by two, so with P points and Euler number chi there are 2 (P - chi) of them
// (docs/theory/5-surfaces.md#spider-web). Every point is a hit, but for articulation points.
SurfacePreview Atlas::preview(double tau, const Context& context) const {
    const EnvironmentScope scope(context);
    const ActiveObjects active = this->active(tau, false, context);  // rejects non-finite isovalues
    const bool is_3d = info().extent.rank == 3;
    SurfacePreview preview;
    preview.tau = tau;
    preview.objects = static_cast<std::int64_t>(active.objects.size());
    preview.contours = active.contour_count;
    for (const ActiveObject& object : active.objects) preview.tunnels += object.b1;
    const LevelCensus::Counts counts = AtlasAccess::census(*this).at(tau, !is_floating(info().type));
    preview.voxels = counts.samples;
    preview.cells = counts.cells;
    preview.points = preview.triangles = counts.hits;
    if (is_3d) {
        const std::int64_t chi = 2 * (preview.contours - preview.tunnels);  // tunnels: the sum of the genera
        for (std::int64_t* count : {&preview.triangles.min, &preview.triangles.max}) *count = std::max<std::int64_t>(0, 2 * (*count - chi));
    }
    const StoredSamples::Foreseen reads = AtlasAccess::samples(*this).foresee(tau);
    preview.bricks = bounds(reads.min.bricks, reads.max.bricks);
    preview.bytes = bounds(reads.min.bytes, reads.max.bytes);
    preview.extents = bounds(reads.min.extents, reads.max.extents);
    return preview;
}

}  // namespace isoatlas
