// What a Zarr array or an image of OME-Zarr says of its volume.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/zarr/key_store.h"
#include "formats/zarr/multiscale.h"
#include "formats/zarr/zarr_array.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// An array, and the image that it is a level of, if it is one.
struct ZarrImage {
    ZarrArray array;
    std::optional<Multiscale> multiscale{};
    std::size_t level = 0;         ///< of the multiscale
    std::vector<Index3> levels{};  ///< sizes, where a level can be chosen
};

/// The axes of the array. Throws Error{unsupported} where they are not clear.
[[nodiscard]] ZarrAxes axes_of(const KeyStore& store, const ZarrImage& image);
/// Sizes along x, y and z.
[[nodiscard]] Index3 size_of_level(const ZarrArray& array, const ZarrAxes& axes);
/// The description, with the chosen time step and channel, without chunks. Throws Error: input, usage.
[[nodiscard]] VolumeInfo zarr_info(const KeyStore& store, const std::string& path, const ZarrImage& image, const ZarrAxes& axes,
                                   const OpenOptions& options);

}  // namespace isoatlas
