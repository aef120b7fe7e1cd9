// The header of NIfTI-1 and NIfTI-2 files in host byte order. Source: nifti1.h and nifti2.h of the NIfTI working group.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace isoatlas {

inline constexpr std::int64_t kNifti1HeaderBytes = 348, kNifti2HeaderBytes = 540;

struct NiftiHeader {
    int version = 1;
    bool big_endian = false;
    bool pair = false;  ///< samples in an .img file
    bool is_analyze = false;
    std::string analyze_unit;           ///< of lengths
    std::array<std::int64_t, 8> dim{};  ///< dim[0]: number of dimensions
    int datatype = 0, bits = 0;
    std::array<double, 8> pixdim{};  ///< pixdim[0]: the sign of the third axis of the qform
    double vox_offset = 0;
    double slope = 0, intercept = 0;
    int units = 0;
    std::string description;
    int qform_code = 0, sform_code = 0;
    std::array<double, 3> quaternion{}, offset{};
    std::array<std::array<double, 4>, 3> rows{};  ///< the sform
};

/// Kind of NIfTI header by the first bytes of a file.
enum class NiftiKind : std::uint8_t { no, nifti1, nifti2, analyze };
/// Looks at the size field and the magic; bytes may be fewer than a header. analyze: an old header without magic.
[[nodiscard]] NiftiKind nifti_kind(std::span<const std::byte> bytes);

/// Decodes a header of kind nifti1 or analyze (348 bytes) or nifti2 (540 bytes). No field is checked.
[[nodiscard]] NiftiHeader decode_nifti(std::span<const std::byte> bytes, NiftiKind kind);

}  // namespace isoatlas
