// A surface in all its levels of detail at once: clusters of triangles, of which many different choices are a whole surface.
//
// Clusters of a level are gathered in groups; a group is simplified as a whole while its border stays, and what comes out of it is cut into
// clusters of the next level, which are gathered differently. In the literature: a directed acyclic graph of clusters (Cignoni et al.,
// Adaptive tetrapuzzles, 2004; Karis, Nanite, 2021). Here every choice has the topology of the exact surface.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "isoatlas/level_of_detail.h"
#include "isoatlas/viewpoint.h"

namespace isoatlas {

struct Cluster {
    std::int64_t first_triangle = 0, triangles = 0;  ///< of ClusterHierarchy::surface; at most ClusterOptions::triangles
    std::int64_t made_by = -1;                       ///< the group whose simplification it is part of; -1: it is part of the exact surface
    std::int64_t replaced_by = -1;                   ///< the group whose simplification replaces it; -1: none does
};

/// Clusters that are replaced together. Groups are numbered so that those that made its clusters come before it.
struct ClusterGroup {
    double distance = 0;                ///< what replaces it and the exact surface are at most so far apart, both ways
    Vec3 centre{};                      ///< physical; a ball around it contains the group, and those of the groups that made its clusters
    double radius = 0;                  ///< physical
    std::vector<std::int64_t> made_of;  ///< the groups that made its clusters; ascending
};

/// Clusters come in the order of the distance of what replaces them, the greatest first, triangles as their clusters, points as they are
/// used: coarse surfaces need the beginnings of the arrays.
struct ClusterHierarchy {
    Surface surface;  ///< the triangles of all clusters and their points; no surface by itself
    std::vector<Cluster> clusters;
    std::vector<ClusterGroup> groups;
    DistanceUnit unit = DistanceUnit::voxel;  ///< of ClusterGroup::distance
};

struct ClusterOptions {
    DistanceUnit unit = DistanceUnit::voxel;  ///< of ClusterHierarchy
    double first_distance = 1.0 / 16;  ///< what groups of the first level may deviate, in smallest sample steps; twice with each level
    std::int64_t triangles = 128;      ///< of a cluster, at most; 1 or more
    std::int64_t clusters = 32;        ///< of a group, about; 1 or more
};

/// Theorem: let a choice of groups contain with each group those that made its clusters. Then the clusters that a chosen group made, or
/// none, and no chosen group replaces are a surface with the contours of `surface`, each with its genus, nested alike, closed where
/// `surface` is, without crossings; both are at most as far apart as the greatest distance of a chosen group says, both ways.
/// docs/theory/10-level-of-detail.md has the proof. Throws Error as simplify_surface(). The same bytes for any number of threads.
/// Cost: some 150 us a triangle on one processor. Memory: some 300 bytes a triangle, of which a budget of the environment keeps what it
/// allows in memory and the rest in its scratch file (environment.h).
[[nodiscard]] ClusterHierarchy make_clusters(Surface surface, const Geometry& geometry, const Extent& extent,
                                             const ClusterOptions& options = {}, const Context& context = {});

/// Of each group: how many pixels what replaces it is at most from the exact surface, as it is seen where its ball comes nearest to the
/// eye; a sixteenth of that where its ball is outside the view. At least those of the groups that made its clusters: the groups of at most
/// so many pixels are a choice. length: physical, of a unit of ClusterGroup::distance in the direction where it is longest. Throws
/// Error{usage}: length is not positive; as require_viewpoint(). Source: Cignoni et al., 2004, and Karis, 2021, as above.
[[nodiscard]] std::vector<double> pixels_of_groups(const ClusterHierarchy& hierarchy, const Viewpoint& from, double length = 1);

/// The surface of a choice: is_chosen is asked once for each group whose made_of are all chosen. Cost: O(hierarchy).
[[nodiscard]] Surface surface_of_choice(const ClusterHierarchy& hierarchy, const std::function<bool(std::int64_t)>& is_chosen);
/// Coarser and coarser ones, each with at most a third of the triangles of the one before; fewer than `most` where the hierarchy has no
/// coarser one. Their distances are in ClusterHierarchy::unit.
[[nodiscard]] std::vector<SimplifiedSurface> coarser_surfaces(const ClusterHierarchy& hierarchy, std::int64_t most);
/// The coarsest one in which every group is at most so far from the exact surface, in ClusterHierarchy::unit.
[[nodiscard]] Surface surface_within(const ClusterHierarchy& hierarchy, double distance);

}  // namespace isoatlas
