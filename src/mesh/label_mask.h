// One label of a label volume as a volume of its own.
#pragma once

#include <cstdint>

#include "isoatlas/filter.h"
#include "isoatlas/labels.h"
#include "isoatlas/volume.h"

namespace isoatlas {

inline constexpr double kMaskLevel = 0.5;  ///< the isovalue of the surface of a mask

/// The box of a region and the voxels around it, as far as the volume has them: its surface lies inside.
[[nodiscard]] SampleBox box_around(const LabelRegion& region, const Extent& extent);

/// 1 where a sample of the box is the label, else 0; it lies where the box does.
[[nodiscard]] Volume mask_of(const Volume& volume, std::int64_t label, const SampleBox& box);

}  // namespace isoatlas
