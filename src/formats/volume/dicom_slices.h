// Slices of DICOM files: where each frame lies, what its values mean, and which of them are one volume.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/volume/dicom_header.h"
#include "formats/volume/dicom_pixels.h"
#include "isoatlas/volume.h"

namespace isoatlas {

struct DicomFile {
    DicomHeader header;
    DicomPixels pixels;
};

/// What may tell slices at one place apart, in the order in which it is tried.
inline constexpr std::array<const char*, 7> kDicomKeys{"TemporalPositionIdentifier", "EchoTime",        "TriggerTime", "DiffusionBValue",
                                                       "AcquisitionNumber",          "AcquisitionTime", "ImageType"};

struct DicomSlice {
    std::size_t file = 0;  ///< in the list of files
    std::int64_t frame = 0;
    std::optional<Vec3> position;  ///< of the first sample, mm
    Vec3 row{1, 0, 0}, column{0, 1, 0};
    std::optional<std::array<double, 2>> spacing;  ///< along a row and along a column, mm
    bool is_detector_spacing = false;              ///< ImagerPixelSpacing
    double slope = 1, intercept = 0;
    std::array<std::string, kDicomKeys.size()> keys;
    double along = 0;  ///< position along the normal, mm
};

/// Slices that may be one volume: of one series, size, type, orientation and pixel spacing; or one picture that has no place.
struct DicomGroup {
    std::vector<DicomSlice> slices;
    std::string word;  ///< that chooses it: the identifier of its series, with a number where that is not unique
};

/// The slices of a file, one for each frame. Throws Error{input} for places that are none.
[[nodiscard]] std::vector<DicomSlice> dicom_slices(const DicomFile& file, std::size_t number);

/// Groups in an order that does not depend on the names of files: number of the series, its identifier, sizes, orientation.
[[nodiscard]] std::vector<DicomGroup> dicom_groups(const std::vector<DicomFile>& files);

/// "CT, 120 slices, 512 x 512, 0.7 x 0.7 x 1.5 mm, axial, DESCRIPTION". For the eyes of who chooses; nothing of it is written anywhere.
[[nodiscard]] std::string about_group(const DicomGroup& group, const std::vector<DicomFile>& files);

[[nodiscard]] Vec3 dicom_normal(const DicomSlice& slice);
[[nodiscard]] double dot_product(const Vec3& a, const Vec3& b);

}  // namespace isoatlas
