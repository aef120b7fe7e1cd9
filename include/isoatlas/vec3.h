// Vec3: a point or a direction in space, or a number for each axis. Mat3: a linear map.
#pragma once

#include <array>

namespace isoatlas {

using Vec3 = std::array<double, 3>;
using Mat3 = std::array<Vec3, 3>;  ///< rows

}  // namespace isoatlas
