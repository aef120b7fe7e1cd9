// Code that uses the library GDCM. A program links it (dicom_library.cpp), or loads it when it first meets a compressed frame
// (formats/on_demand): its dictionaries take 15 ms at every start.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "formats/volume/dicom_pixels.h"

namespace isoatlas {

/// decode_dicom_frame() for the JPEG family.
using DicomDecoder = std::string (*)(const std::string& syntax, const DicomPixels& pixels, std::span<const std::byte> packed,
                                     std::span<std::byte> out);

/// dicom_gdcm.cpp, where the build has it.
[[nodiscard]] std::string decode_with_gdcm(const std::string& syntax, const DicomPixels& pixels, std::span<const std::byte> packed,
                                           std::span<std::byte> out);

/// file: that needs it, with frames of the transfer syntax. Throws Error{unsupported, Reason::built_without_format}.
[[nodiscard]] DicomDecoder dicom_decoder(const std::string& file, const std::string& syntax);

}  // namespace isoatlas
