// What a TIFF file of many pages and a folder of TIFF files have in common.
#pragma once

#include <string>
#include <vector>

#include "formats/volume/tiff_description.h"
#include "formats/volume/tiff_file.h"

namespace isoatlas {

/// Voxel size from the description, else from the resolution tags, else 1. What had to be guessed becomes a note.
[[nodiscard]] Geometry tiff_geometry(const TiffTags& tags, const TiffDescription& description, std::int64_t slices,
                                     std::vector<std::string>& notes);
/// Says what the reader ignored: colour tables, previews.
void add_tiff_notes(const TiffFile& file, std::vector<std::string>& notes);

}  // namespace isoatlas
