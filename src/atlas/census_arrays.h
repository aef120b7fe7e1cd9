// A census (census/level_census.h) as arrays of a store, and back.
//
//   census/value                         ascending
//   census/samples                       samples of at least that value
//   census/cells_high, cells_low         cells whose highest, lowest corner is at least that value
//   census/hits_high, hits_low           the same for edges of the grid
#pragma once

#include <vector>

namespace isoatlas {

class Container;
struct LevelCensus;
struct PackedArray;

/// The census must live until the arrays are packed.
[[nodiscard]] std::vector<PackedArray> census_arrays(const LevelCensus& census);

/// Throws Error{input} when it is inconsistent.
[[nodiscard]] LevelCensus census_of(const Container& store);

}  // namespace isoatlas
