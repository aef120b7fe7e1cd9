// The formats behind write_curves: one function each.
#pragma once

#include "isoatlas/simplify.h"
#include "isoatlas/volume.h"

namespace isoatlas {

// Each writes the whole file.
void write_curves_json(Sink& sink, const VolumeInfo& info, const std::vector<SelectionCurve>& curves);
void write_curves_csv(Sink& sink, const VolumeInfo& info, const std::vector<SelectionCurve>& curves);
void write_curves_svg(Sink& sink, const VolumeInfo& info, const std::vector<SelectionCurve>& curves);

/// Thresholds of hypervolume and persistence in reported values.
[[nodiscard]] double reported_threshold(const VolumeInfo& info, const SelectionCurve& curve, double threshold);

}  // namespace isoatlas
