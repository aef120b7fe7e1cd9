// Geometry of a NIfTI file: sform before qform before pixdim.
#pragma once

#include <array>
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
/// The directions of the axes as a reader finds them from b, c, d alone: a = sqrt(1 - b^2 - c^2 - d^2), so near a half turn, where a is
/// small, it has half of their digits. nullopt: not finite.
[[nodiscard]] std::optional<std::array<Vec3, 3>> rotation_of_qform(const Vec3& quaternion, bool is_mirrored);

}  // namespace isoatlas
