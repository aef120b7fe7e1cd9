// Selects the NRRD axes of the volume and their geometry.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/volume/nrrd_header.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// The axes of the file that become x, y (and z), and the number of volumes along the time axis.
struct NrrdAxes {
    std::vector<std::size_t> spatial;  ///< 2 or 3 axis numbers, rising
    std::vector<std::int64_t> sizes;   ///< of all axes
    std::int64_t volumes = 1;
};

/// Chooses the axes by dimension, sizes and kinds: axes of size 1 that hold colours or scalars fall away, a last fourth axis is time.
/// Throws Error: input (bad sizes), unsupported (several values per sample, time not last, fewer than 2 or more than 4 axes).
[[nodiscard]] NrrdAxes choose_nrrd_axes(const NrrdHeader& header, std::vector<std::string>& notes);

/// Fills in info.geometry from spacings / axis mins / space directions / space origin / units. Throws Error{input} on contradictions.
void read_nrrd_geometry(const NrrdHeader& header, const NrrdAxes& axes, VolumeInfo& info);

}  // namespace isoatlas
