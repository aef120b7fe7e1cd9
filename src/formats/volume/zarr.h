// Zarr arrays and images of OME-Zarr as volumes, from any store of keys.
#pragma once

#include <memory>
#include <string>

#include "formats/zarr/key_store.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Opens the array or image at the path `inside` of a hierarchy ("": its root), and below it at options.dataset. Reads metadata only.
/// path: of the volume, as the user gave it. Throws as open_volume().
[[nodiscard]] std::unique_ptr<VolumeReader> open_zarr_store(std::shared_ptr<KeyStore> store, const std::string& path,
                                                            const std::string& inside, const OpenOptions& options);

}  // namespace isoatlas
