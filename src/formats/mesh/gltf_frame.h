// The node of a GLB that turns the space of a volume into that of glTF: metres, y up, the front towards +z.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace isoatlas {

using GltfMatrix = std::array<double, 16>;  ///< columns, as in glTF

/// Value of extras.frame of that node: the coordinates below it are those of the volume.
inline constexpr const char* kVolumeFrame = "volume";

/// From points of a volume with this space and unit to glTF: left to +x, superior to +y, anterior to +z; of other spaces z to +y and -y to
/// +z, as for LPS. Unknown units count as millimetres. Of determinant below 0 for LAS alone.
[[nodiscard]] GltfMatrix gltf_frame(const std::string& space, const std::string& unit);

/// Whether two matrices are the same but for rounding.
[[nodiscard]] bool is_same_matrix(const GltfMatrix& a, const GltfMatrix& b);

}  // namespace isoatlas
