// Isovalues as users and programs write them: decimals in reported (calibrated) units.
#pragma once

#include "isoatlas/volume.h"

namespace isoatlas {

/// The stored isovalue that a decimal in reported units means. A decimal that names a sample value (of float samples: the shortest one; of
/// calibrated ones: to seven digits) becomes that sample value, bit for bit: High means >=, so a last-digit difference would lose the
/// plateau. reported: finite.
[[nodiscard]] double stored_isovalue(const VolumeInfo& info, double reported);

}  // namespace isoatlas
