// Simplifies a part of a surface whose border stays, beside all that can be there.
#pragma once

#include "base/cancel.h"
#include "level_of_detail/versions.h"

namespace isoatlas {

struct GroupLimits {
    double max_distance;  ///< of the group and what replaces it, both ways
    BoundingBox box;      ///< in which what replaces it lies, scaled
};

/// Collapses edges until a quarter of the triangles is left or no edge can be. is_locked: of each point of the versions, whether triangles
/// beyond the group have it. No triangles are returned where nothing could be collapsed.
[[nodiscard]] Replacement simplify_group(const Versions& versions, std::int64_t group, std::span<const TriangleCorners> triangles,
                                         std::span<const std::uint8_t> is_locked, const GroupLimits& limits,
                                         const CallerLooks& stop_if_asked);

}  // namespace isoatlas
