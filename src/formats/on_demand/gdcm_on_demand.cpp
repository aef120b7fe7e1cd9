// In place of formats/volume/dicom_library.cpp.
#include "formats/on_demand/load_part.h"
#include "formats/volume/dicom_library.h"

namespace isoatlas {

DicomDecoder dicom_decoder(const std::string& file, const std::string&) {
    static const auto* const decoder = static_cast<const DicomDecoder*>(load_part("gdcm", "GDCM", file));
    return *decoder;
}

}  // namespace isoatlas
