// Eigenvectors of a symmetric matrix.
#pragma once

#include "isoatlas/volume.h"

namespace isoatlas {

struct SymmetricAxes {
    Mat3 direction{};  ///< rows: orthonormal, right-handed
    Vec3 value{};      ///< eigenvalues, descending
};

/// The same numbers on every machine: the largest component of the first two rows is positive. Source: Jacobi's rotations (Golub, Van Loan:
/// Matrix Computations, section 8.5).
[[nodiscard]] SymmetricAxes symmetric_axes(Mat3 matrix);

}  // namespace isoatlas
