// Measures as members of JSON documents.
#pragma once

#include <isoatlas/isoatlas.h>

#include "text/document.h"

namespace isoatlas::cli {

/// Millilitres in the cube of a unit of length; nullopt: the unit is not one of the metre.
[[nodiscard]] std::optional<double> millilitres(const std::string& unit);

[[nodiscard]] Json measures_json(const ObjectMeasures& object, const VolumeInfo& info);
[[nodiscard]] Json sizes_json(const SizeDistribution& sizes);
/// low, high: one number for each axis of the volume.
[[nodiscard]] Json percolation_json(const Percolation& percolation, const VolumeInfo& info);

}  // namespace isoatlas::cli
