// The description of a volume in JSON files.
#pragma once

#include "formats/common/json_stream.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Member "volume" of the object that is open: path, extent, type, geometry, units, calibration.
void put_volume(JsonStream& json, const VolumeInfo& info);

}  // namespace isoatlas
