// Basins of maxima with numbers tile after tile, for work on one tile at a time.
#pragma once

#include <vector>

#include "base/big_vector.h"
#include "base/bit_ranks.h"
#include "critical/basins.h"
#include "critical/tiling.h"
#include "isoatlas/context.h"

namespace isoatlas {

template <class Number>
struct TiledBasins {
    BigVector<Number> maximum;  ///< per voxel: the number of a maximum above it
    std::vector<Number> first;  ///< per tile: the number of its first maximum; and of the end
    BitRanks open;              ///< maxima that may be basins or representatives in another tile than their own
};

/// Cost: O(voxels) time, a byte a voxel beyond the result, and a Number each maximum.
template <class T, class Number>
[[nodiscard]] TiledBasins<Number> tiled_basins(const GridView<T>& grid, const Tiling& tiling, const Context& context);

}  // namespace isoatlas
