// The critical elements of a store: position, kind and value.
//
//   elements/place, form   position and kind (atlas/element_form.h)
//   elements/value         its value, descending
//
// They are stored in the order of the analysis. With more than half as many elements as voxels (noise) that order would dominate the size:
// then they are in the order of the grid, ascending by place, then form, without values, and order and values are recomputed from the
// samples (docs/decisions/0020). Earlier stores have places in the order of the analysis there too, with values rounded to the type of the
// samples (decision 15).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/big_vector.h"

namespace isoatlas {

class Container;
struct Context;
struct PackedArray;
struct VolumeInfo;

/// values, codes: of all elements, descending; they must live until the arrays are packed. Id: of places. Cost: of noise a sort, 16 bytes
/// an element while it runs and 8 until they are packed.
template <class Id>
[[nodiscard]] std::vector<PackedArray> element_arrays(std::span<const double> values, std::span<const std::uint64_t> codes,
                                                      const VolumeInfo& volume, int threads);

/// Codes and values, descending. samples: of the volume, x fastest; null: those of the store, which are read if needed. Throws Error: input
/// (arrays inconsistent with each other or the samples), cancelled.
template <class Id>
void read_elements(const Container& store, const std::byte* samples, const Context& context, BigVector<std::uint64_t>& codes,
                   BigVector<double>& values);

}  // namespace isoatlas
