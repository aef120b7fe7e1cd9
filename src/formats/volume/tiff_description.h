// Parses the ImageDescription tag of a TIFF file by ImageJ: how the pages form a volume, and the voxel size.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "isoatlas/volume.h"

namespace isoatlas {

struct TiffDescription {
    bool is_imagej = false;
    std::int64_t images = 0;                            ///< pages in all; 0: missing
    std::int64_t channels = 1, slices = 1, frames = 1;  ///< page = channel + channels * (slice + slices * frame)
    Vec3 spacing{0, 0, 0};                              ///< 0: missing
    std::string unit{};                                 ///< "um", "mm", ...; empty: missing, or pixels
    double frame_interval = 0;                          ///< 0: missing
    std::string time_unit{};
    Calibration calibration{};
    std::string value_unit{};
};

/// Anything else than ImageJ gives an empty one. Never throws; invalid values count as missing.
[[nodiscard]] TiffDescription parse_tiff_description(std::string_view text);

}  // namespace isoatlas
