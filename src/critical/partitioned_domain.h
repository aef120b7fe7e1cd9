// Critical elements of a grid, in the order of ranks and partitioned into tiles: the input of trees in bounded memory.
#pragma once

#include <cstdint>

#include "base/big_vector.h"
#include "critical/grid_scan.h"
#include "critical/partitioned_set.h"
#include "critical/tiling.h"

namespace isoatlas {

template <class Number>
struct PartitionedCriticals {
    ByElement<Number, double> value;
    ByElement<Number, std::uint64_t> code;  ///< ElementCode bits
    BigVector<std::uint16_t> part_of;       ///< by rank: the tile
    PartitionedSet<Number> set;
};

/// Tiles so small that what is done to one of them on every thread stays well within the memory limit (base/memory_limit.h); their sides
/// are those of slabs where the context sets slabs. At most 65536.
[[nodiscard]] Tiling tiling_for(const Extent& extent, const Context& context);

/// Consumes the scan. Cost: O(voxels + c log c) time; every pass runs through its arrays in order, or stays within some tiles.
template <class Number>
[[nodiscard]] PartitionedCriticals<Number> parted_criticals(const Extent& extent, GridScan scan, const Tiling& tiling,
                                                            const Context& context);

}  // namespace isoatlas
