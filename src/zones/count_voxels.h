// Voxels per critical element, without the trees: what sizes of zones are sums of.
#pragma once

#include <cstdint>
#include <span>

#include "base/big_vector.h"
#include "field/grid.h"
#include "isoatlas/context.h"

namespace isoatlas {

/// Per element how many voxels belong to it: to the lowest element on the way down the join tree from the voxel that is not below the
/// voxel's value. The voxels of a zone are those of the elements of its event (tree/criticality_tree.h): values between two elements of
/// an object belong to the upper one. value, code: of all elements, by rank. basin: kept from GridDomain::critical(), or empty.
/// Works on one tile a thread at a time, and on what spans tiles in descending order: memory may be short.
/// Cost: O(n alpha + voxels log(voxels of a tile)).
template <class T, class Id>
[[nodiscard]] BigVector<Id> voxels_of_elements(const GridView<T>& grid, std::span<const double> value, std::span<const std::uint64_t> code,
                                               BigVector<Id> basin, const Context& context);

}  // namespace isoatlas
