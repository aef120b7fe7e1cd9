// Bytes of linear light by a table against the formula.
#include "render/colours.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isoatlas {
namespace {

TEST(SrgbEncoder, EveryByteIsThatOfTheFormula) {
    const SrgbEncoder& encoder = SrgbEncoder::instance();
    constexpr int kSteps = 100'000;
    for (int i = -5; i <= kSteps + 5; ++i) {
        const double light = static_cast<double>(i) / kSteps;
        ASSERT_EQ(encoder.byte(light), srgb_byte(light)) << light;
    }
    for (int byte = 0; byte < 256; ++byte) {  // beside the edge between two bytes
        const double edge = to_linear((byte + 0.5) / 255);
        for (const double light : {std::nextafter(edge, 0) * (1 - 1e-14), edge * (1 + 1e-14)})
            ASSERT_EQ(encoder.byte(light), srgb_byte(light)) << byte;
    }
}

}  // namespace
}  // namespace isoatlas
