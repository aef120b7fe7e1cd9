// Parses the ImageDescription tag of a TIFF file by ImageJ or OME: how the pages form a volume, and the voxel size.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "isoatlas/volume.h"

namespace isoatlas {

struct TiffDescription {
    enum class Kind : std::uint8_t { none, imagej, ome } kind = Kind::none;
    std::int64_t images = 0;  ///< pages in all; 0: missing
    std::int64_t channels = 1, slices = 1, frames = 1;
    bool frames_are_fastest = false;  ///< page = frame + frames * slice, else slice + slices * frame
    Vec3 spacing{0, 0, 0};            ///< 0: missing
    std::string unit;                 ///< "um", "mm", ...; empty: missing, or pixels
    Calibration calibration;
    std::string value_unit;
};

/// Anything else than ImageJ or OME gives kind none. Never throws; invalid values count as missing.
[[nodiscard]] TiffDescription parse_tiff_description(std::string_view text);

}  // namespace isoatlas
