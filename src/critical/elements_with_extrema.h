// Critical elements with their representatives: these are looked up while elements lie in the order of the grid, and move with an element
// when it is sorted.
#pragma once

#include <span>
#include <vector>

#include "base/big_vector.h"
#include "critical/grid_scan.h"
#include "critical/partitioned_set.h"
#include "critical/representative_lookup.h"

namespace isoatlas {

template <class Number>
struct ElementWithExtrema {
    KeyedElement key;
    Representatives<Number> representatives;
};

/// In the order of the grid.
template <class Number>
using ChunksWithExtrema = std::vector<BigVector<ElementWithExtrema<Number>>>;

/// first_number: per slab, of GridScan. Cost: O(voxels).
template <class Number>
[[nodiscard]] BigVector<Number> resolve_basins(const Extent& extent, std::int64_t height, Direction direction,
                                               std::span<const std::uint8_t> links, const std::vector<std::int64_t>& first_number,
                                               int threads);

/// Basins of maxima. links: of links_of_grid(). Cost: O(voxels).
template <class Number>
[[nodiscard]] BigVector<Number> basins_of_maxima(const Extent& extent, std::span<const std::uint8_t> links, const Context& context);

/// Finds the extrema around all elements; consumes links and chunks of the scan. new_maximum, new_minimum: per extremum the
/// one to be used instead; empty: its own. upward: null, or where the basins of maxima are to be kept. Cost: O(voxels).
template <class Number>
[[nodiscard]] ChunksWithExtrema<Number> elements_with_extrema(const Extent& extent, GridScan& scan,
                                                              IdSpan<MaximumIdOf<Number>, const MaximumIdOf<Number>> new_maximum,
                                                              IdSpan<MinimumIdOf<Number>, const MinimumIdOf<Number>> new_minimum,
                                                              BigVector<Number>* upward, int threads);

}  // namespace isoatlas
