// What is wrong with a surface, edge by edge and triangle by triangle: for pictures that show it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// inspect() (isoatlas/surface.h) counts, this says where.
struct SurfaceDefects {
    using Edge = std::array<std::int64_t, 2>;  ///< points, ascending
    std::vector<Edge> hole_edges{};            ///< one triangle, and not in an end of the volume: the rims of holes
    std::vector<Edge> non_manifold_edges{};    ///< more than two triangles
    std::vector<std::int64_t> zero_area_triangles{};
    std::int64_t components = 0;  ///< points that triangles join
    std::int64_t euler = 0;       ///< points of triangles - edges + triangles
    std::int64_t rims = 0;        ///< closed lines of edges with one triangle: of holes, and where the surface leaves the volume
    bool rims_meet = false;       ///< at some point more than two such edges meet: then rims cannot be told apart
};
/// info: of the volume that the surface was made from. Cost: a sort of the edges.
[[nodiscard]] SurfaceDefects find_defects(const Surface& surface, const VolumeInfo& info);

/// Handles of all components together, once a disk closes each rim: (2 components - Euler number - rims) / 2. None: edges with more than
/// two triangles, or rims that meet.
[[nodiscard]] std::optional<std::int64_t> genus_of(const SurfaceDefects& defects);

/// Components of a surface beside those of another one of the same samples and isovalue, by the edges between neighbouring samples that
/// they cross. Edges that one of both does not cross are left out: contours of slices cross none along z.
struct ComponentDifference {
    std::int64_t components = 0;  ///< of the surface
    std::int64_t wrong = 0;       ///< that cross not exactly the edges that one component of the reference crosses
    /// Ascending. Components of surface and reference that share the most edges, each from the view of the other, are partners; these
    /// triangles belong to no partner, or touch edges of the reference that belong to another.
    std::vector<std::int64_t> misplaced_triangles{};
};
/// Points on samples cross no edge; components of such points alone are not judged, so that isovalues between samples say most. Cost: a
/// sort of the points.
[[nodiscard]] ComponentDifference compare_components(const Surface& surface, const Surface& reference, const VolumeInfo& info);

}  // namespace isoatlas
