// The formats behind write_curves: one function each.
#pragma once

#include "base/atomic_file.h"
#include "isoatlas/simplify.h"
#include "isoatlas/volume.h"

namespace isoatlas {

// Each writes the whole file and commits.
void write_curves_json(AtomicFile& file, const VolumeInfo& info, const std::vector<SelectionCurve>& curves);
void write_curves_csv(AtomicFile& file, const VolumeInfo& info, const std::vector<SelectionCurve>& curves);
void write_curves_svg(AtomicFile& file, const VolumeInfo& info, const std::vector<SelectionCurve>& curves);

/// Thresholds of hypervolume and persistence in reported values.
[[nodiscard]] double reported_threshold(const VolumeInfo& info, const SelectionCurve& curve, double threshold);

}  // namespace isoatlas
