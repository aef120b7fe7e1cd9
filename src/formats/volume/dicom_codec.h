// Compressed frames of DICOM files. RLE is decoded here; the JPEG family by GDCM, where it is there (dicom_library.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "formats/volume/dicom_pixels.h"

namespace isoatlas {

/// The most bytes of samples that a byte of a compressed frame can stand for; 0: this transfer syntax is not decoded at all.
[[nodiscard]] std::int64_t largest_dicom_ratio(const std::string& syntax);

/// Decodes a frame to samples in host byte order. Returns what is wrong with it; "" for none. Throws Error{unsupported,
/// Reason::built_without_format} where GDCM is needed and missing.
[[nodiscard]] std::string decode_dicom_frame(const std::string& path, const std::string& syntax, const DicomPixels& pixels,
                                             std::span<const std::byte> packed, std::span<std::byte> out);

/// What a code stream of the JPEG family says of itself in contradiction to the data set; "": nothing. Decoders rely on the agreement.
[[nodiscard]] std::string jpeg_contradiction(const DicomPixels& pixels, std::span<const std::byte> packed);

}  // namespace isoatlas
