// Noise estimation: a standard deviation for the whole volume, and one that grows with the value (docs/theory/8-noise-and-stability.md).
//
// Counting detectors (PET, light microscopes) have more noise where the signal is strong: one number for the whole volume is that of the
// background, and noise in regions of high values would pass for objects.
//
// In the literature: noise variance estimation from second differences (Immerkaer 1996); signal-dependent noise (Foi et al., Practical
// Poissonian-Gaussian noise modeling and fitting, 2008).
#pragma once

#include <algorithm>

#include "field/volume_view.h"

namespace isoatlas {

/// The largest of three estimates, in stored units: median absolute second difference along x / (0.6745 sqrt 6); square root of the 20th
/// percentile of the non-zero variances of 3^3 (3^2) neighbourhoods; quantum / sqrt 12 for integers. The second is left out when there is
/// no noise: more than a fiftieth of the neighbourhoods are constant, those at the lowest and the highest sample aside, where scanners cut
/// off. From at most about 10^6 samples on a fixed pattern: the same number for any thread count. Cost: O(min(voxels, 10^6)).
[[nodiscard]] double estimate_noise(const VolumeView& volume);

/// Standard deviation of the noise around a value: sigma, or more by a line through the quiet neighbourhoods.
struct NoiseModel {
    double sigma = 0;            ///< of estimate_noise()
    double base = 0, slope = 0;  ///< base + slope * (value - low) for low <= value <= high, constant beyond
    double low = 0, high = 0;

    [[nodiscard]] double at(double value) const { return std::max(sigma, base + slope * (std::clamp(value, low, high) - low)); }
};

/// Neighbourhoods are grouped by their mean, finer towards high ones; of each group the 20th percentile of the variance around the plane
/// that fits best is taken: edges and texture only add to it. The line is the quantile regression through the groups at 0.3, in relative
/// terms, for the same reason. It has a slope only when that explains the groups twice as well as none, and when the same holds for the
/// median of the finest second difference, to which smooth structure adds nothing. Cost: as above.
[[nodiscard]] NoiseModel fit_noise(const VolumeView& volume);

/// Median of the second difference along all axes at once, as the standard deviation of independent noise: smooth structure and edges along
/// an axis leave nothing in it, unlike in estimate_noise(); of correlated noise it sees little. From neighbourhoods on a fixed pattern,
/// without those that are constant at an end of the range; 0 when there are none. Cost: as above.
[[nodiscard]] double finest_noise(const VolumeView& volume);

/// How many of first, first + stride, ... are less than end.
[[nodiscard]] inline std::size_t count_by(std::int64_t first, std::int64_t end, std::int64_t stride) {
    return first < end ? static_cast<std::size_t>((end - first + stride - 1) / stride) : 0;
}

}  // namespace isoatlas
