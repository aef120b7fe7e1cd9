// The elements of DICOM files that are read; everything else is skipped.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "formats/volume/dicom_header.h"

namespace isoatlas {

/// What a wanted element holds.
enum class DicomHolds : std::uint8_t { text, u16, u16_or_i16, f64, sequence };

struct WantedElement {
    DicomTag parent;  ///< the sequence that it lies in; 0: the data set
    DicomTag tag;
    DicomHolds holds = DicomHolds::text;
};

inline constexpr DicomTag kPlanePosition = 0x00209113, kPlaneOrientation = 0x00209116, kPixelMeasures = 0x00289110,
                          kValueTransformation = 0x00289145, kFrameContent = 0x00209111, kEcho = 0x00189114, kDiffusion = 0x00189117,
                          kDetector = 0x00540022;

inline constexpr WantedElement kWantedElements[] = {{0, kDicomImageType},
                                                    {0, kDicomInstance},
                                                    {0, kDicomAcquisitionTime},
                                                    {0, kDicomModality},
                                                    {0, kDicomSeriesDescription},
                                                    {0, kDicomSliceThickness},
                                                    {0, kDicomEchoTime},
                                                    {0, kDicomSpacingBetweenSlices},
                                                    {0, kDicomTriggerTime},
                                                    {0, kDicomFrameTime},
                                                    {0, kDicomImagerSpacing},
                                                    {0, kDicomBValue, DicomHolds::f64},
                                                    {0, kDicomSeries},
                                                    {0, kDicomSeriesNumber},
                                                    {0, kDicomAcquisitionNumber},
                                                    {0, kDicomPosition},
                                                    {0, kDicomOrientation},
                                                    {0, kDicomTemporalPosition},
                                                    {0, kDicomTemporalResolution},
                                                    {0, kDicomSamplesPerPixel, DicomHolds::u16},
                                                    {0, kDicomPhotometric},
                                                    {0, kDicomNumberOfFrames},
                                                    {0, kDicomRows, DicomHolds::u16},
                                                    {0, kDicomColumns, DicomHolds::u16},
                                                    {0, kDicomPixelSpacing},
                                                    {0, kDicomBitsAllocated, DicomHolds::u16},
                                                    {0, kDicomBitsStored, DicomHolds::u16},
                                                    {0, kDicomHighBit, DicomHolds::u16},
                                                    {0, kDicomPixelRepresentation, DicomHolds::u16},
                                                    {0, kDicomPadding, DicomHolds::u16_or_i16},
                                                    {0, kDicomPaddingLimit, DicomHolds::u16_or_i16},
                                                    {0, kDicomIntercept},
                                                    {0, kDicomSlope},
                                                    {0, kDicomRescaleType},
                                                    {0, kDicomUnits},
                                                    {0, kDicomDoseUnits},
                                                    {0, kDicomFrameOffsets},
                                                    {0, kDicomDoseScaling},
                                                    {0, kDicomShared, DicomHolds::sequence},
                                                    {0, kDicomPerFrame, DicomHolds::sequence},
                                                    {0, kDetector, DicomHolds::sequence},
                                                    {kDetector, kDicomPosition},
                                                    {kDetector, kDicomOrientation},
                                                    {kPlanePosition, kDicomPosition},
                                                    {kPlaneOrientation, kDicomOrientation},
                                                    {kPixelMeasures, kDicomPixelSpacing},
                                                    {kPixelMeasures, kDicomSliceThickness},
                                                    {kPixelMeasures, kDicomSpacingBetweenSlices},
                                                    {kValueTransformation, kDicomIntercept},
                                                    {kValueTransformation, kDicomSlope},
                                                    {kValueTransformation, kDicomRescaleType},
                                                    {kFrameContent, kDicomTemporalIndex, DicomHolds::u16},  // UL: see number_text()
                                                    {kEcho, kDicomEffectiveEchoTime, DicomHolds::f64},
                                                    {kDiffusion, kDicomBValue, DicomHolds::f64}};

inline constexpr DicomTag kDicomGroups[] = {kPlanePosition, kPlaneOrientation, kPixelMeasures, kValueTransformation, kFrameContent,
                                            kEcho,          kDiffusion};

inline const WantedElement* find_wanted_element(DicomTag parent, DicomTag tag) {
    static constexpr WantedElement kGroup{0, 0, DicomHolds::sequence};
    if ((parent == kDicomShared || parent == kDicomPerFrame) && std::ranges::count(kDicomGroups, tag) > 0) return &kGroup;
    const auto found =
        std::ranges::find_if(kWantedElements, [&](const WantedElement& wanted) { return wanted.parent == parent && wanted.tag == tag; });
    return found == std::end(kWantedElements) ? nullptr : found;
}

}  // namespace isoatlas
