// How noisy are the samples? One standard deviation for the whole volume (essential.md section 2).
#pragma once

#include "field/volume_view.h"

namespace isoatlas {

/// The largest of three estimates, in stored units: median absolute second difference along x / (0.6745 sqrt 6); square root of the 20th
/// percentile of the non-zero variances of 3^3 (3^2) neighbourhoods; quantum / sqrt 12 for integers. From at most about 10^6 samples on a
/// fixed pattern: the same number for any thread count. Cost: O(min(voxels, 10^6)).
[[nodiscard]] double estimate_noise(const VolumeView& volume);

}  // namespace isoatlas
