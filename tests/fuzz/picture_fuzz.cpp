// The readers of PNG, JPEG and BMP take any bytes: a documented error or a sound volume.
#include "formats/volume/formats.h"
#include "fuzz/volume_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::open_and_read(isoatlas::open_picture, data, size);
}
