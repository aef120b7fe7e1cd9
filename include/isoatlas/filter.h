// Filter: cropping and Gaussian filtering of volumes, before they are analysed.
#pragma once

#include <array>
#include <cstdint>

#include "isoatlas/volume.h"

namespace isoatlas {

/// The part of a volume in a box, where it lies in space. Throws Error{usage} when the box is empty or exceeds the volume. Cost: O(box).
[[nodiscard]] Volume crop(const Volume& volume, const SampleBox& box);

/// The samples averaged with the weights of a Gaussian of standard deviation `sigma`, in the unit of the spacing, the same along every axis
/// of space whatever the spacing. One axis after the other (the filter is separable), weights exp(-d^2 / 2 sigma^2) at distances d of whole
/// samples, sum 1, none beyond 4 sigma (rounded to samples). Beyond the ends of the volume the last sample is repeated.
/// The samples keep their type, integers are rounded to the nearest one (docs/decisions/0010), and their calibration.
/// info.gaussian of the result is sigma; filtered twice: the root of the sum of the squares.
/// A slice is made of itself and `gaussian_radius` slices on either side. The same bytes for any number of threads.
/// Throws Error: usage (sigma not positive or above 1000 samples; rectilinear grids), cancelled.
/// Cost: O(voxels * radius) time; memory beyond the result: 2 radius + 1 slices of doubles.
[[nodiscard]] Volume gaussian_filter(const Volume& volume, double sigma, const Context& context = {});

/// How many samples on either side of a sample gaussian_filter reads, per axis. Throws as it does.
[[nodiscard]] Index3 gaussian_radius(const VolumeInfo& info, double sigma);

/// crop(gaussian_filter(volume, sigma), box), without filtering the rest.
[[nodiscard]] Volume gaussian_filter(const Volume& volume, const SampleBox& box, double sigma, const Context& context = {});

}  // namespace isoatlas
