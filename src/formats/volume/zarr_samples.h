// The volume in a Zarr array of more axes: one time step and one channel of it.
#pragma once

#include <memory>

#include "formats/zarr/multiscale.h"
#include "formats/zarr/zarr_array.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// A reader of the samples of `array` at info.volumes.time_step and .channel. info: complete but for its chunks. Every axis of the array is
/// one of `axes`.
[[nodiscard]] std::unique_ptr<VolumeReader> make_zarr_reader(VolumeInfo info, std::shared_ptr<KeyStore> store, ZarrArray array,
                                                             const ZarrAxes& axes);

}  // namespace isoatlas
