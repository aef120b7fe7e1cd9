// A brick comes back bit by bit, whatever is in it and however it is coded; what is not a brick is refused.
#include "codec/brick_codec.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "codec/float_units.h"

namespace isoatlas {
namespace {

template <class T>
struct Brick {
    Index3 size;
    std::vector<T> samples;
};

/// Smooth, rough, or both.
template <class T>
Brick<T> arbitrary_brick() {
    Brick<T> brick;
    for (std::size_t axis = 0; axis < 3; ++axis) brick.size[axis] = *rc::gen::inRange<std::int64_t>(1, kBrickSize[axis] + 1);
    const int noise = *rc::gen::inRange(0, 65), scale = *rc::gen::inRange(-60, 60);
    const auto slope = *rc::gen::container<std::vector<int>>(6, rc::gen::inRange(-9, 9));
    const auto raw = *rc::gen::container<std::vector<std::uint64_t>>(101, rc::gen::arbitrary<std::uint64_t>());
    const std::int64_t nx = brick.size[0], ny = brick.size[1];
    for (std::int64_t i = 0; i < nx * ny * brick.size[2]; ++i) {
        const std::int64_t x = i % nx, y = i / nx % ny, z = i / nx / ny;
        const std::int64_t smooth = slope[0] * x + slope[1] * y + slope[2] * z + slope[3] * x * y + slope[4] * z * z + slope[5];
        const std::uint64_t rough = noise == 0 ? 0 : raw[static_cast<std::size_t>(i % 101)] >> (64 - noise);
        if constexpr (std::is_integral_v<T>) {
            brick.samples.push_back(static_cast<T>(static_cast<std::uint64_t>(smooth) + rough));
        } else {
            brick.samples.push_back(static_cast<T>(std::ldexp(static_cast<double>(smooth) + static_cast<double>(rough) * 1e-9, scale)));
        }
    }
    return brick;
}

template <class T>
std::vector<std::byte> packed_as(const Brick<T>& brick, std::uint8_t head) {
    std::vector<std::byte> packed;
    encode_brick<T>(brick.samples, brick.size, extremes_of<T>(brick.samples).first, head, packed);
    return packed;
}

template <class T>
void check_round_trip(const Brick<T>& brick, std::uint8_t head) {
    const T low = extremes_of<T>(brick.samples).first;
    std::vector<std::byte> packed = packed_as(brick, head);
    std::vector<T> back(brick.samples.size());
    RC_ASSERT(decode_brick<T>(packed, brick.size, low, back));
    RC_ASSERT(std::memcmp(back.data(), brick.samples.data(), back.size() * sizeof(T)) == 0);
    packed.push_back(std::byte{0});
    RC_ASSERT(!decode_brick<T>(packed, brick.size, low, back));
    packed.resize(packed.size() - 2);
    RC_ASSERT(packed.empty() || !decode_brick<T>(packed, brick.size, low, back));
}

template <class T>
void check_choice() {
    const Brick<T> brick = arbitrary_brick<T>();
    const T low = extremes_of<T>(brick.samples).first;
    const BrickCode code = choose_code<T>(brick.samples, brick.size, low);
    RC_ASSERT(static_cast<std::int64_t>(packed_as(brick, code.head).size()) == code.bytes);
    RC_ASSERT(code.bytes <= static_cast<std::int64_t>((brick.samples.size() + 7) / 8 * 8 * sizeof(T) + 3));
    check_round_trip(brick, code.head);
    for (const int head : {static_cast<int>(code.head), 0, 21, 42, 64, 128, 192, 255}) {
        const BrickCode same = code_as<T>(brick.samples, brick.size, low, static_cast<std::uint8_t>(head));
        RC_ASSERT(same.head == head || same.head == code.head);  // that of the first byte, or a chosen one where it does not fit
        RC_ASSERT(static_cast<std::int64_t>(packed_as(brick, same.head).size()) == same.bytes);
    }
}

RC_GTEST_PROP(BrickCodec, GivesTheSameBits, ()) {
    check_choice<std::uint8_t>();
    check_choice<std::int8_t>();
    check_choice<std::uint16_t>();
    check_choice<std::int16_t>();
    check_choice<std::uint32_t>();
    check_choice<std::int32_t>();
    check_choice<float>();
    check_choice<double>();
}

RC_GTEST_PROP(BrickCodec, EveryCodeGivesTheSameBits, ()) {
    const int orders = *rc::gen::inRange(0, 3) | *rc::gen::inRange(0, 3) << 2 | *rc::gen::inRange(0, 3) << 4;
    check_round_trip(arbitrary_brick<std::int16_t>(), static_cast<std::uint8_t>(orders));
    check_round_trip(arbitrary_brick<float>(), static_cast<std::uint8_t>(orders));
}

template <class T>
void decode_anything(std::span<const std::byte> bytes) {
    Index3 size;
    for (std::int64_t& n : size) n = *rc::gen::inRange<std::int64_t>(1, 9);
    std::vector<T> samples(static_cast<std::size_t>(size[0] * size[1] * size[2]));
    (void)decode_brick<T>(bytes, size, T{1}, samples);
}

RC_GTEST_PROP(BrickCodec, AnyBytesAreSafe, (std::vector<std::uint8_t> bytes)) {
    if (bytes.size() > 4) bytes[1] %= 20, bytes[2] %= 4;
    decode_anything<std::uint8_t>(std::as_bytes(std::span(bytes)));
    decode_anything<float>(std::as_bytes(std::span(bytes)));
    decode_anything<double>(std::as_bytes(std::span(bytes)));
}

TEST(BrickCodec, WhatIsNoNumberStays) {
    using Limits = std::numeric_limits<float>;
    const Brick<float> brick{{2, 2, 1}, {Limits::infinity(), -0.0F, -Limits::quiet_NaN(), Limits::denorm_min()}};
    const float low = extremes_of<float>(brick.samples).first;
    check_round_trip(brick, choose_code<float>(brick.samples, brick.size, low).head);
}

TEST(BrickCodec, SmoothSamplesTakeLittle) {
    Brick<float> brick{kBrickSize, {}};
    for (int i = 0; i < kBrickSamples; ++i)
        brick.samples.push_back(static_cast<float>((i % 16) * (i % 16) + i / 16 % 8 - i / 128 * 3) - 40.25F);
    const BrickCode code = choose_code<float>(brick.samples, brick.size, extremes_of<float>(brick.samples).first);
    EXPECT_LT(code.bytes, kBrickSamples / 8);
    check_round_trip(brick, code.head);
}

/// A brick of the full size, whose samples differ by about a part `noise` of its range; the others are zeros.
template <class T>
Brick<T> noisy_brick(double noise, int zeros_in_ten) {
    Brick<T> brick{kBrickSize, {}};
    std::mt19937 random(7);
    const auto draw = [&random] { return static_cast<double>(random()) / 4294967296.0; };
    for (int i = 0; i < kBrickSamples; ++i) {
        const double value = 100 * ((1 - noise) * (i % 16 + i / 128) / 24 + noise * draw());
        brick.samples.push_back(static_cast<int>(random() % 10) < zeros_in_ten ? T{0} : static_cast<T>(value));
    }
    return brick;
}

/// Round trips with every code that fits the samples: of floats one of the two kinds in units does.
template <class T>
void check_every_code(const Brick<T>& brick) {
    std::vector<int> kinds{0};
    if constexpr (std::is_floating_point_v<T>) kinds.push_back(units_of<T>(brick.samples)->exact ? 64 : 128);
    for (int orders = 0; orders < 27; ++orders) {
        for (const int kind : kinds)
            check_round_trip(brick, static_cast<std::uint8_t>(kind | orders % 3 | orders / 3 % 3 << 2 | orders / 9 << 4));
    }
    check_round_trip(brick, 192);
}

TEST(BrickCodec, WholeBricksGiveTheSameBits) {
    for (const double noise : {0.0, 0.01, 1.0}) {
        for (const int zeros : {0, 1, 9}) {
            check_every_code(noisy_brick<float>(noise, zeros));
            check_every_code(noisy_brick<double>(noise, zeros));
            check_every_code(noisy_brick<std::uint16_t>(noise, zeros));
        }
    }
}

TEST(BrickCodec, SamplesStayAsTheyAreWhereCodingSavesLessThanAnEighth) {
    Brick<std::uint16_t> brick{kBrickSize, {}};
    const auto bytes_with = [&brick](int bits) {
        std::mt19937 random(8);
        brick.samples.clear();
        for (int i = 0; i < kBrickSamples; ++i) brick.samples.push_back(static_cast<std::uint16_t>(random() >> (32 - bits)));
        return choose_code<std::uint16_t>(brick.samples, brick.size, extremes_of<std::uint16_t>(brick.samples).first);
    };
    EXPECT_EQ(bytes_with(15).head, 192);
    EXPECT_EQ(bytes_with(15).bytes, 1 + 2 * kBrickSamples);
    EXPECT_EQ(bytes_with(13).head, 0);
    EXPECT_LT(bytes_with(13).bytes, 2 * kBrickSamples * 7 / 8);
    check_round_trip(brick, 192);
}

TEST(BrickCodec, FloatsStayAsTheyAreWhereCodingSavesLessThanAQuarter) {
    Brick<float> brick{kBrickSize, {}};
    const auto code_with = [&brick](int bits) {  // the lowest bits of each sample are noise
        std::mt19937 random(9);
        brick.samples.clear();
        for (int i = 0; i < kBrickSamples; ++i)
            brick.samples.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(0x30000000U + (random() >> (32 - bits)))));
        return choose_code<float>(brick.samples, brick.size, extremes_of<float>(brick.samples).first);
    };
    EXPECT_EQ(code_with(26).head, 192);
    EXPECT_EQ(code_with(26).bytes, 1 + 4 * kBrickSamples);
    EXPECT_NE(code_with(22).head, 192);
    EXPECT_LT(code_with(22).bytes, 3 * kBrickSamples);
    check_round_trip(brick, 192);
}

TEST(BrickCodec, ConstantBricksHaveNoBytes) {
    std::vector<std::int16_t> samples(7);
    EXPECT_TRUE(decode_brick<std::int16_t>({}, {7, 1, 1}, -5, samples));
    EXPECT_EQ(samples, std::vector<std::int16_t>(7, -5));
}

TEST(BrickCodec, UnknownCodesAreRefused) {
    const Brick<std::uint8_t> brick{{3, 1, 1}, {1, 2, 4}};
    std::vector<std::byte> packed = packed_as(brick, 0);
    std::vector<std::uint8_t> back(3);
    ASSERT_TRUE(decode_brick<std::uint8_t>(packed, brick.size, 1, back));
    for (const int head : {3, 12, 48, 64, 128, 192, 193, 255}) {
        packed[0] = static_cast<std::byte>(head);
        EXPECT_FALSE(decode_brick<std::uint8_t>(packed, brick.size, 1, back)) << head;
    }
}

}  // namespace
}  // namespace isoatlas
