// The arrays of an image of OME-Zarr 0.4 that is written: its levels of resolution, in chunks.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "formats/zarr/folder_output.h"
#include "formats/zarr/zarr_json.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// How samples of a level become one of the next.
enum class Coarsening : bool {
    mean,  ///< of the 8 (of an image 4) that it covers; of integers the nearest one, halves to even
    first  ///< the one with the lowest indices: for labels
};

/// Writes the arrays `path`/0, 1, ... of an image: its samples, then every other sample along each axis, until no axis has more than 128.
/// Chunks are encoded by blosc; those of zeros alone are left out. info: geometry, extent, type. Returns the member "multiscales".
/// Memory: 1/7 of the samples and a chunk. Throws Error{resource}.
[[nodiscard]] Json write_zarr_levels(FolderOutput& folder, const std::string& path, const std::string& name, const VolumeInfo& info,
                                     std::span<const std::byte> samples, Coarsening coarsening);

/// What OME-Zarr has no place for: directions of the axes, space, calibration, units; for this reader.
[[nodiscard]] Json zarr_remainder(const VolumeInfo& info);

inline constexpr const char* kZarrGroup = "{\"zarr_format\": 2}";

}  // namespace isoatlas
