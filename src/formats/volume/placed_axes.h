// Axes of a volume whose samples have a place each, with a unit: NeXus and NetCDF.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

struct PlacedAxis {
    std::string name{}, unit{};
    std::vector<double> places{};  ///< one for each sample, or for each end of a sample (one more); empty: not given
};

/// Sets spacing and origin where places are even, else coordinates, and the unit of length; what cannot be used is left out, with a note.
/// Axes that descend: the axis is turned around, or where places are uneven `flipped` says that its samples must come in reverse order.
void set_placed_axes(VolumeInfo& info, std::array<PlacedAxis, 3> axes, std::array<bool, 3>& flipped);

}  // namespace isoatlas
