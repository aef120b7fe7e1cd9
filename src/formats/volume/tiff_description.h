// What ImageJ and OME write into the ImageDescription tag of a TIFF file: how the pages form a volume and how large a voxel is.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "isoatlas/volume.h"

namespace isoatlas {

struct TiffDescription {
    enum class Kind : std::uint8_t { none, imagej, ome } kind = Kind::none;
    std::int64_t images = 0;  ///< pages in all; 0: not said
    std::int64_t channels = 1, slices = 1, frames = 1;
    bool frames_are_fastest = false;  ///< page = frame + frames * slice, else slice + slices * frame
    Vec3 spacing{0, 0, 0};            ///< 0: not said
    std::string unit;                 ///< "um", "mm", ...; empty: not said, or pixels
    Calibration calibration;
    std::string value_unit;
};

/// Anything else than ImageJ or OME gives kind none. Never throws; nonsense values count as not said.
[[nodiscard]] TiffDescription parse_tiff_description(std::string_view text);

}  // namespace isoatlas
