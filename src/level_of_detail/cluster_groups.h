// Which clusters of a level are simplified together, and which of these groups at the same time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "level_of_detail/versions.h"

namespace isoatlas {

/// Cubes with this edge, beginning `shift` before the lowest point.
struct GroupGrid {
    Vec3 low;
    double edge, shift;
};

/// Clusters by the cube in which the middle of their box lies; one that is alone in its cube goes with the largest group beside it.
[[nodiscard]] std::vector<std::vector<std::int64_t>> grouped(const Versions& versions, std::span<const std::int64_t> clusters,
                                                             const GroupGrid& grid);

/// A colour for each box, as small numbers as it goes in their order: boxes of a colour are apart.
[[nodiscard]] std::vector<std::size_t> colours_of(std::span<const BoundingBox> boxes);

/// Marks the points of the clusters that more than one group has. is_locked: of each point of the versions.
void lock_borders(const Versions& versions, std::span<const std::vector<std::int64_t>> groups, Array<std::uint8_t>& is_locked);

}  // namespace isoatlas
