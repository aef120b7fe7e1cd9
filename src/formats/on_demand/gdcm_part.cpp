// The library that formats/on_demand/gdcm_on_demand.cpp loads.
#include "formats/volume/dicom_library.h"

extern "C" const void* isoatlas_part();
extern "C" const void* isoatlas_part() {
    static constexpr isoatlas::DicomDecoder kDecoder = isoatlas::decode_with_gdcm;
    return static_cast<const void*>(&kDecoder);
}
