// What choices of a hierarchy have, without making their surfaces.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "isoatlas/cluster_hierarchy.h"

namespace isoatlas {

/// The clusters of the surface of a choice, ascending: as surface_of_choice().
[[nodiscard]] std::vector<std::int64_t> clusters_of_choice(const ClusterHierarchy& hierarchy,
                                                           const std::function<bool(std::int64_t)>& is_chosen);
[[nodiscard]] std::int64_t triangles_of(const ClusterHierarchy& hierarchy, const std::vector<std::int64_t>& clusters);
/// Triangles of surface_within(); points and triangles of the hierarchy are not needed.
[[nodiscard]] std::int64_t triangles_within(const ClusterHierarchy& hierarchy, double distance);

}  // namespace isoatlas
