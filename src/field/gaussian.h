// The Gaussian filter of isoatlas/filter.h, in place.
#pragma once

#include <cstddef>

#include "isoatlas/filter.h"

namespace isoatlas {

/// Replaces the samples of a volume, and records the filter in info. Reads and writes slices once, in their order.
/// Memory beyond the samples: 2 * gaussian_radius + 1 slices of doubles. Throws as gaussian_filter().
void filter_in_place(VolumeInfo& info, std::byte* samples, double sigma, const Context& context);

}  // namespace isoatlas
