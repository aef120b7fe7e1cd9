// The decoder of bricks takes any bytes: they are samples, or refused. Byte 0: the type of the samples, bytes 1 to 3: the sizes of the box,
// bytes 4 to 11: the lowest sample; then the brick.
#include <cstdint>
#include <cstring>

#include "codec/brick_codec.h"
#include "field/volume_view.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 12) return 0;
    const isoatlas::Index3 box{data[1] % 16 + 1, data[2] % 8 + 1, data[3] % 8 + 1};
    isoatlas::visit_type(static_cast<isoatlas::ValueType>(data[0] % 8), [&]<class T>(T low) {
        std::memcpy(&low, data + 4, sizeof low);
        std::vector<T> samples(static_cast<std::size_t>(box[0] * box[1] * box[2]));
        (void)isoatlas::decode_brick<T>(std::as_bytes(std::span(data + 12, size - 12)), box, low, samples);
    });
    return 0;
}
