// The DICOM reader takes any bytes: a documented error or a sound volume.
#include "formats/volume/formats.h"
#include "fuzz/volume_target.h"

/// GDCM forgets its copy of a frame of JPEG-LS that it cannot decode, and what OpenJPEG holds of one of JPEG 2000 (GDCM, pull request 189).
/// No more than one frame of a file: it is refused then.
extern "C" const char* __lsan_default_suppressions() { return "leak:libgdcm\nleak:libopenjp2\n"; }  // NOLINT(bugprone-reserved-identifier)

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::open_and_read(isoatlas::open_dicom, data, size);
}
