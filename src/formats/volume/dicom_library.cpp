// Alone in its file: a program that loads GDCM on demand, or a test without it, has another one.
#include "formats/volume/dicom_library.h"

#include "formats/volume/dicom_header.h"
#include "isoatlas/error.h"

namespace isoatlas {

#ifdef ISOATLAS_WITH_GDCM

DicomDecoder dicom_decoder(const std::string&, const std::string&) { return decode_with_gdcm; }

#else

DicomDecoder dicom_decoder(const std::string& file, const std::string& syntax) {
    throw Error(ErrorKind::unsupported,
                {.file = file,
                 .what = "the pictures are compressed by " + name_of_syntax(syntax) + ", which this build cannot decode",
                 .expected = "a build with GDCM",
                 .next = "install the package libgdcm-dev and build again, or decompress the files with gdcmconv",
                 .reason = Reason::built_without_format,
                 .value = "GDCM"});
}

#endif

}  // namespace isoatlas
