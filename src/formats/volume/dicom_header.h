// The elements of a DICOM file that place its picture: of the data set, of the groups that all frames share, and of each frame.
//
// Names, dates, institutions and other elements about people are never read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isoatlas {

using DicomTag = std::uint32_t;  ///< group * 65536 + element

/// Values of a data set, as texts without padding; numbers of binary elements as decimal texts, separated by backslashes as others.
class DicomValues {
public:
    void add(DicomTag tag, std::string value) { values_.emplace_back(tag, std::move(value)); }
    [[nodiscard]] const std::string* find(DicomTag tag) const;
    [[nodiscard]] std::string text(DicomTag tag) const;  ///< "": missing
    /// The numbers of a value; nullopt: missing, or one of them is not a finite number.
    [[nodiscard]] std::optional<std::vector<double>> numbers(DicomTag tag) const;
    [[nodiscard]] std::optional<double> number(DicomTag tag) const;  ///< the first
    [[nodiscard]] bool empty() const { return values_.empty(); }

private:
    std::vector<std::pair<DicomTag, std::string>> values_;
};

struct DicomSyntax {
    std::string uid;
    bool is_implicit = false, big_endian = false, deflated = false, encapsulated = false;
};
/// "JPEG 2000"; the identifier itself where it is not a known one.
[[nodiscard]] std::string name_of_syntax(const std::string& uid);

struct DicomHeader {
    std::string path;
    std::int64_t file_bytes = 0;
    DicomSyntax syntax;
    std::int64_t data_set = 0;  ///< offset in the file where the deflated stream begins
    DicomValues values, shared;
    std::vector<DicomValues> frames;  ///< of the functional groups of each frame; empty: there are none
    DicomTag pixel_tag = 0;           ///< 0: the file holds no picture
    std::int64_t pixels = 0;          ///< position of the first byte of the picture, in the inflated data set where it is deflated
    std::int64_t pixel_bytes = -1;    ///< -1: in fragments
    std::int64_t bound = 0;           ///< at most so many bytes follow there
};

/// Whether a file begins like one: "DICM" at byte 128, or as a data set without that. Never throws.
[[nodiscard]] bool starts_like_dicom(std::span<const std::byte> first);
/// Reads up to the picture. Memory: the wanted elements, which lie in the file. Throws Error{input} for a damaged or truncated file.
[[nodiscard]] DicomHeader read_dicom_header(const std::string& path);

// Tags.
inline constexpr DicomTag kDicomTransferSyntax = 0x00020010, kDicomImageType = 0x00080008, kDicomInstance = 0x00080018,
                          kDicomAcquisitionTime = 0x00080032, kDicomModality = 0x00080060, kDicomSeriesDescription = 0x0008103E,
                          kDicomSliceThickness = 0x00180050, kDicomEchoTime = 0x00180081, kDicomSpacingBetweenSlices = 0x00180088,
                          kDicomTriggerTime = 0x00181060, kDicomFrameTime = 0x00181063, kDicomImagerSpacing = 0x00181164,
                          kDicomEffectiveEchoTime = 0x00189082, kDicomBValue = 0x00189087, kDicomSeries = 0x0020000E,
                          kDicomSeriesNumber = 0x00200011, kDicomAcquisitionNumber = 0x00200012, kDicomPosition = 0x00200032,
                          kDicomOrientation = 0x00200037, kDicomTemporalPosition = 0x00200100, kDicomTemporalResolution = 0x00200110,
                          kDicomTemporalIndex = 0x00209128, kDicomSamplesPerPixel = 0x00280002, kDicomPhotometric = 0x00280004,
                          kDicomNumberOfFrames = 0x00280008, kDicomRows = 0x00280010, kDicomColumns = 0x00280011,
                          kDicomPixelSpacing = 0x00280030, kDicomBitsAllocated = 0x00280100, kDicomBitsStored = 0x00280101,
                          kDicomHighBit = 0x00280102, kDicomPixelRepresentation = 0x00280103, kDicomPadding = 0x00280120,
                          kDicomPaddingLimit = 0x00280121, kDicomIntercept = 0x00281052, kDicomSlope = 0x00281053,
                          kDicomRescaleType = 0x00281054, kDicomUnits = 0x00541001, kDicomDoseUnits = 0x30040002,
                          kDicomFrameOffsets = 0x3004000C, kDicomDoseScaling = 0x3004000E, kDicomShared = 0x52009229,
                          kDicomPerFrame = 0x52009230, kDicomFloatPixels = 0x7FE00008, kDicomDoublePixels = 0x7FE00009,
                          kDicomPixels = 0x7FE00010, kDicomItem = 0xFFFEE000, kDicomItemEnd = 0xFFFEE00D, kDicomSequenceEnd = 0xFFFEE0DD;

}  // namespace isoatlas
