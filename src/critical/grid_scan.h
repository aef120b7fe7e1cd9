// The slab passes over a whole grid: links of all voxels and all critical elements, before their representatives are known.
#pragma once

#include <cstdint>
#include <vector>

#include "base/big_vector.h"
#include "critical/scan.h"
#include "isoatlas/context.h"

namespace isoatlas {

struct GridScan {
    std::int64_t height = 0;                                 ///< slices of a slab
    BigVector<std::uint8_t> links;                           ///< per voxel (critical/links.h)
    std::vector<BigVector<KeyedElement>> chunks;             ///< critical elements
    std::vector<std::int64_t> first_maximum, first_minimum;  ///< per slab: how many extrema lie in the slabs before
    std::int64_t maxima = 0, minima = 0, elements = 0;
};

/// Slices per slab: given by the context, or enough slabs for all threads.
[[nodiscard]] std::int64_t slab_height(const Extent& extent, const Context& context);

/// tunnel_height: of tunnel_height_of (critical/bodies.h). Cost: O(voxels); a byte a voxel and 16 bytes a critical element.
template <class T>
[[nodiscard]] GridScan scan_grid(const GridView<T>& grid, double tunnel_height, const Context& context);

/// The links alone. Cost: O(voxels), a byte a voxel.
template <class T>
[[nodiscard]] BigVector<std::uint8_t> links_of_grid(const GridView<T>& grid, const Context& context);

}  // namespace isoatlas
