// The total order of critical elements restored from their codes and the samples.
#pragma once

#include <cstdint>

#include "base/big_vector.h"
#include "critical/element_values.h"
#include "field/volume_view.h"

namespace isoatlas {

/// Puts codes into the order that the analysis gave them (Above, field/order.h), whatever order they are in, and finds their values.
/// values: is made as long. Returns false, with codes and values of no use, where the samples have no such element. tunnel_height: of
/// tunnel_height_of(). Cost: O(n log n); 32 bytes a code while it runs.
[[nodiscard]] bool sort_codes(const VolumeView& volume, double tunnel_height, int threads, BigVector<std::uint64_t>& codes,
                              BigVector<double>& values, SaddleValues saddles = SaddleValues::exact);

}  // namespace isoatlas
