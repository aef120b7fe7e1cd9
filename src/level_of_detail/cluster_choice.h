// What choices of a hierarchy have, without making their surfaces.
#pragma once

#include <cstdint>

#include "isoatlas/cluster_hierarchy.h"

namespace isoatlas {

/// Triangles of surface_within(); points and triangles of the hierarchy are not needed.
[[nodiscard]] std::int64_t triangles_within(const ClusterHierarchy& hierarchy, double distance);

}  // namespace isoatlas
