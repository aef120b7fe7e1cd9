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

namespace dicom {  // tags
constexpr DicomTag kTransferSyntax = 0x00020010, kImageType = 0x00080008, kInstance = 0x00080018, kAcquisitionTime = 0x00080032,
                   kModality = 0x00080060, kSeriesDescription = 0x0008103E, kSliceThickness = 0x00180050, kEchoTime = 0x00180081,
                   kSpacingBetweenSlices = 0x00180088, kTriggerTime = 0x00181060, kFrameTime = 0x00181063, kImagerSpacing = 0x00181164,
                   kEffectiveEchoTime = 0x00189082, kBValue = 0x00189087, kSeries = 0x0020000E, kSeriesNumber = 0x00200011,
                   kAcquisitionNumber = 0x00200012, kPosition = 0x00200032, kOrientation = 0x00200037, kTemporalPosition = 0x00200100,
                   kTemporalResolution = 0x00200110, kTemporalIndex = 0x00209128, kSamplesPerPixel = 0x00280002, kPhotometric = 0x00280004,
                   kNumberOfFrames = 0x00280008, kRows = 0x00280010, kColumns = 0x00280011, kPixelSpacing = 0x00280030,
                   kBitsAllocated = 0x00280100, kBitsStored = 0x00280101, kHighBit = 0x00280102, kPixelRepresentation = 0x00280103,
                   kPadding = 0x00280120, kPaddingLimit = 0x00280121, kIntercept = 0x00281052, kSlope = 0x00281053,
                   kRescaleType = 0x00281054, kUnits = 0x00541001, kDoseUnits = 0x30040002, kFrameOffsets = 0x3004000C,
                   kDoseScaling = 0x3004000E, kShared = 0x52009229, kPerFrame = 0x52009230, kFloatPixels = 0x7FE00008,
                   kDoublePixels = 0x7FE00009, kPixels = 0x7FE00010, kItem = 0xFFFEE000, kItemEnd = 0xFFFEE00D, kSequenceEnd = 0xFFFEE0DD;
}

}  // namespace isoatlas
