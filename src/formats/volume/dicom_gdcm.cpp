// The only file that uses GDCM, the library for DICOM of Debian: its decoders of the JPEG family.
#include <algorithm>
#include <cstring>
#include <exception>
#include <vector>

#include "formats/volume/dicom_library.h"

#include <gdcmFragment.h>
#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

namespace isoatlas {
namespace {

gdcm::SmartPointer<gdcm::Image> gdcm_image(const std::string& syntax, const DicomPixels& pixels, std::span<const std::byte> packed) {
    gdcm::SmartPointer<gdcm::Image> image = new gdcm::Image;
    image->SetNumberOfDimensions(2);
    image->SetDimension(0, static_cast<unsigned>(pixels.columns));
    image->SetDimension(1, static_cast<unsigned>(pixels.rows));
    const auto bits = [](int count) { return static_cast<unsigned short>(count); };
    // Of 8 bits GDCM demands that all are stored; the others are left out of what it decodes (formats/volume/dicom_pixels.cpp).
    const bool is_byte = pixels.allocated == 8;
    image->SetPixelFormat(gdcm::PixelFormat(1, bits(pixels.allocated), bits(is_byte ? 8 : pixels.stored),
                                            bits(is_byte ? 7 : pixels.high_bit), pixels.is_signed ? 1 : 0));
    image->SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
    image->SetTransferSyntax(gdcm::TransferSyntax::GetTSType(syntax.c_str()));
    gdcm::Fragment fragment;
    fragment.SetByteValue(reinterpret_cast<const char*>(packed.data()), gdcm::VL(static_cast<std::uint32_t>(packed.size())));
    gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
    fragments->AddFragment(fragment);
    gdcm::DataElement element(gdcm::Tag(0x7FE0, 0x0010));
    element.SetVR(gdcm::VR::OB);
    element.SetValue(*fragments);
    image->SetDataElement(element);
    return image;
}

}  // namespace

std::string decode_with_gdcm(const std::string& syntax, const DicomPixels& pixels, std::span<const std::byte> packed,
                             std::span<std::byte> out) {
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    gdcm::Trace::DebugOff();
    constexpr std::size_t kMostPacked = 0xFFFFFFFE;
    if (packed.size() > kMostPacked) return "it has more than 4 GB";
    try {
        const gdcm::SmartPointer<gdcm::Image> image = gdcm_image(syntax, pixels, packed);
        if (image->GetBufferLength() != out.size()) return "GDCM expects another size";
        return image->GetBuffer(reinterpret_cast<char*>(out.data())) ? "" : "GDCM cannot decode it";
    } catch (const std::exception&) {  // its messages may quote the data set
        return "GDCM cannot decode it";
    }
}

}  // namespace isoatlas
