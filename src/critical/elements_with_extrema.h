// Critical elements with their representatives: these are looked up while elements lie in the order of the grid, and move with an element
// when it is sorted.
#pragma once

#include <span>
#include <vector>

#include "critical/grid_scan.h"
#include "critical/partitioned_set.h"
#include "critical/representative_lookup.h"

namespace isoatlas {

template <class Id>
struct ElementWithExtrema {
    KeyedElement key;
    Representatives<Id> representatives;
};

/// In the order of the grid.
template <class Id>
using ChunksWithExtrema = std::vector<BigVector<ElementWithExtrema<Id>>>;

/// first_number: per slab, of GridScan. Cost: O(voxels).
template <class Id>
[[nodiscard]] BigVector<Id> resolve_basins(const Extent& extent, std::int64_t height, Direction direction,
                                           std::span<const std::uint8_t> links, const std::vector<std::int64_t>& first_number, int threads);

/// Basins of maxima. links: of links_of_grid(). Cost: O(voxels).
template <class Id>
[[nodiscard]] BigVector<Id> basins_of_maxima(const Extent& extent, std::span<const std::uint8_t> links, const Context& context);

/// Finds the extrema around all elements; consumes links and chunks of the scan. new_maximum, new_minimum: per number of an extremum the
/// one to be used instead; empty: its own. upward: null, or where the basins of maxima are to be kept. Cost: O(voxels).
template <class Id>
[[nodiscard]] ChunksWithExtrema<Id> elements_with_extrema(const Extent& extent, GridScan& scan, std::span<const Id> new_maximum,
                                                          std::span<const Id> new_minimum, BigVector<Id>* upward, int threads);

}  // namespace isoatlas
