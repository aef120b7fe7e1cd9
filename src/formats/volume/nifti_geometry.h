// Geometry of a NIfTI file: sform before qform before pixdim.
#pragma once

#include <string>
#include <vector>

#include "formats/volume/nifti_header.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Space is "RAS" with an sform or qform, else "unknown" (then axes, spacing from pixdim, origin 0). Contradictions and corrections become
/// notes.
[[nodiscard]] Geometry nifti_geometry(const NiftiHeader& header, int rank, std::vector<std::string>& notes);

}  // namespace isoatlas
