// Geometry of a NIfTI file: sform before qform before pixdim.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/volume/nifti_header.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Space is "RAS" with an sform or qform, else "unknown" (then axes, spacing from pixdim, origin 0). Contradictions and corrections become
/// notes.
[[nodiscard]] Geometry nifti_geometry(const NiftiHeader& header, int rank, std::vector<std::string>& notes);

/// The rotation of a qform: a quaternion (a, b, c, d) of unit length with a >= 0.
struct NiftiRotation {
    Vec3 quaternion;   ///< b, c, d
    bool is_mirrored;  ///< the third axis is reversed after the rotation
};
/// nullopt: the axes are not perpendicular. Source: nifti1_io.c, nifti_mat44_to_quatern.
[[nodiscard]] std::optional<NiftiRotation> nifti_rotation(const Mat3& direction);

}  // namespace isoatlas
