// Shared by multi-page TIFF files and folders of TIFF files.
#pragma once

#include <string>
#include <vector>

#include "formats/volume/tiff_description.h"
#include "formats/volume/tiff_file.h"

namespace isoatlas {

/// Voxel size from the description, else from the resolution tags, else 1. Assumptions become notes.
[[nodiscard]] Geometry tiff_geometry(const TiffTags& tags, const TiffDescription& description, std::int64_t slices,
                                     std::vector<std::string>& notes);
/// Adds notes about ignored data: colour tables, previews.
void add_tiff_notes(const TiffFile& file, std::vector<std::string>& notes);

}  // namespace isoatlas
