// The contour tree of partitioned elements, without random access to an array of all elements.
// In the literature: contour trees by domain decomposition (Morozov, Weber, Distributed contour trees, 2014).
#pragma once

#include <cstdint>
#include <span>

#include "critical/partitioned_set.h"
#include "isoatlas/context.h"

namespace isoatlas {

/// ContourTree::other of all elements and the outside, in the order of ranks. part_of: per element in the order of ranks, its part. The set
/// is consumed. Reports progress of "trees". Memory at random: what reduce_part() needs for a part (as many at once as there are threads),
/// the representatives and the runs of survivors (tree/arcs_by_runs.h). Cost: O(n alpha).
template <class Number>
[[nodiscard]] ByElement<Number, ElementIdOf<Number>> contour_arcs(PartitionedSet<Number> set, std::span<const std::uint16_t> part_of,
                                                                  const Context& context);

}  // namespace isoatlas
