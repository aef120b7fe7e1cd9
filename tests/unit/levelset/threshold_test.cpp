// Comparing in the type of the samples is the same as comparing in double.
#include "levelset/threshold.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace isoatlas {
namespace {

template <class T>
void expect_same_comparisons(const std::vector<T>& values, const std::vector<double>& taus) {
    for (const double tau : taus) {
        const Threshold<T> threshold = threshold_for<T>(tau);
        for (const T value : values) {
            EXPECT_EQ(!threshold.none_high && value >= threshold.min, static_cast<double>(value) >= tau) << +value << " at " << tau;
        }
    }
}

template <class T>
std::vector<T> around_the_ends() {
    using Limits = std::numeric_limits<T>;
    return {Limits::lowest(), static_cast<T>(Limits::lowest() + 1), T{0}, T{1}, T{100}, static_cast<T>(Limits::max() - 1), Limits::max()};
}

TEST(Threshold, Integers) {
    const std::vector<double> taus{
        -1e300,       -2147483648.5, -32769,       -32768.5, -32768,  -129,  -128.5, -128, -127.5,       -1,
        -0.5,         -0.0,          0.0,          0.5,      1,       99.5,  100,    127,  127.5,        254.5,
        255,          255.5,         32767,        32767.5,  65534.5, 65535, 65536,  2e9,  2147483646.5, 2147483647.5,
        4294967294.5, 4294967295.0,  4294967295.5, 1e300};
    expect_same_comparisons(around_the_ends<std::uint8_t>(), taus);
    expect_same_comparisons(around_the_ends<std::int8_t>(), taus);
    expect_same_comparisons(around_the_ends<std::uint16_t>(), taus);
    expect_same_comparisons(around_the_ends<std::int16_t>(), taus);
    expect_same_comparisons(around_the_ends<std::uint32_t>(), taus);
    expect_same_comparisons(around_the_ends<std::int32_t>(), taus);
}

TEST(Threshold, Floats) {
    const float third = 1.0F / 3;
    const std::vector<float> values{-std::numeric_limits<float>::max(),
                                    -1,
                                    -0.0F,
                                    0,
                                    std::numeric_limits<float>::denorm_min(),
                                    std::nextafter(third, 0.0F),
                                    third,
                                    std::nextafter(third, 1.0F),
                                    std::numeric_limits<float>::max()};
    std::vector<double> taus{-1e300, -0.0, 0.0, 1.0 / 3, 1e-300, 1e39, 3.5e38, 1e300};
    for (const float v : values) {
        taus.push_back(v);
        taus.push_back(std::nextafter(static_cast<double>(v), 1e300));
        taus.push_back(std::nextafter(static_cast<double>(v), -1e300));
    }
    expect_same_comparisons(values, taus);
    expect_same_comparisons(std::vector<double>{-1e300, -0.0, 0, 1.0 / 3, 1e300}, taus);
}

}  // namespace
}  // namespace isoatlas
