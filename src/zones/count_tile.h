// Voxels per critical element within a tile: a voxel belongs to the lowest element of its component that is not below its value.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "critical/tiled_basins.h"
#include "field/grid.h"
#include "zones/open_voxels.h"

namespace isoatlas {

/// Counts of an element of a tile.
template <class Id>
struct CountedElement {
    Id voxels;                          ///< of components that lie within the tile
    std::array<Id, 2> representatives;  ///< of components above that span tiles; kNoRepresentative: there is none
};
template <class Id>
constexpr Id kNoRepresentative = static_cast<Id>(-1);

/// elements: of the tile, descending. Representatives are ranks in basins.open. open: receives the voxels of components that span tiles.
/// Cost: O(voxels log voxels) of the tile.
template <class T, class Id>
void count_tile(const GridView<T>& grid, const Tiling& tiling, std::int64_t tile, const TiledBasins<Id>& basins,
                std::span<const KeyedElement> elements, std::span<CountedElement<Id>> counted, OpenVoxelBuckets<T, Id>& open);

}  // namespace isoatlas
