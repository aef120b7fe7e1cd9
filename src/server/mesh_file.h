// A surface as the file that write_surface() would write, for a client to keep.
#pragma once

#include <string>

#include "isoatlas/surface.h"

namespace isoatlas::server {

/// extension: ".ply", ".stl", ".obj", ".vtp" or ".glb". Goes through a file in the folder for temporary ones, which is gone afterwards.
/// Throws what write_surface() throws.
[[nodiscard]] std::string mesh_file(const Surface& surface, const std::string& extension);

}  // namespace isoatlas::server
