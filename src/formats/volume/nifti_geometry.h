// Where a NIfTI file puts its voxels: sform before qform before pixdim.
#pragma once

#include <string>
#include <vector>

#include "formats/volume/nifti_header.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Space is "RAS" with an sform or qform, else "unknown" (then axes, spacing from pixdim, origin 0). What was chosen against the
/// file's other statements, or had to be corrected, becomes a note.
[[nodiscard]] Geometry nifti_geometry(const NiftiHeader& header, int rank, std::vector<std::string>& notes);

}  // namespace isoatlas
