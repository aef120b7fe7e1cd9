// The order of a hierarchy: what coarse surfaces need comes first, so that it can be read alone.
#pragma once

#include "isoatlas/cluster_hierarchy.h"

namespace isoatlas {

/// Beginnings of the arrays of a hierarchy.
struct ClusterParts {
    std::int64_t clusters = 0, triangles = 0, points = 0;
};

/// Orders clusters by the distance of what replaces them, the greatest first (none: infinite), triangles as their clusters, points as they
/// are first used. Equal ones keep their order. Points that no triangle uses are dropped. Cost: O(hierarchy).
void order_by_distance(ClusterHierarchy& hierarchy);

/// What the surfaces need that choose every group of at most this distance; of an ordered hierarchy. points: of its cluster i, the points
/// that those before it do not use.
[[nodiscard]] ClusterParts parts_beyond(const ClusterHierarchy& tables, std::span<const std::int64_t> points, double distance);
/// These numbers of points.
[[nodiscard]] std::vector<std::int64_t> points_of_clusters(const ClusterHierarchy& hierarchy);

}  // namespace isoatlas
