// Floats come back from their units bit by bit; units are exact where they can be.
#include "codec/float_units.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace isoatlas {
namespace {

template <class T>
void check_round_trip(const std::vector<T>& samples) {
    const std::optional<Units> units = units_of<T>(samples);
    RC_ASSERT(units.has_value());
    std::vector<Key<T>> numbers;
    for (const T sample : samples) numbers.push_back(in_units(sample, *units));
    std::vector<T> back(samples.size());
    if (units->exact) {
        from_units<T>(numbers, *units, back);
    } else {
        std::vector<std::byte> tails;
        append_tails<T>(samples, *units, tails);
        RC_ASSERT(static_cast<std::int64_t>(tails.size()) == (tail_bits<T>(samples, *units) + 7) / 8);
        RC_ASSERT(join_tails<T>(numbers, tails, *units, back));
        tails.push_back(std::byte{0});
        std::vector<T> other(samples.size());
        RC_ASSERT(!join_tails<T>(numbers, tails, *units, other));
    }
    RC_ASSERT(std::memcmp(back.data(), samples.data(), samples.size() * sizeof(T)) == 0);
}

template <class T>
std::vector<T> arbitrary_samples() {
    const auto raw = *rc::gen::nonEmpty(rc::gen::arbitrary<std::vector<std::int32_t>>());
    const int few = *rc::gen::inRange(0, 32), low = *rc::gen::inRange(-1080, 900), range = *rc::gen::inRange(1, 100);
    std::vector<T> samples;
    for (const std::int32_t r : raw) {
        const double value = std::ldexp(static_cast<double>(r >> few) + 1e-3 * (r & 1), low + *rc::gen::inRange(0, range));
        samples.push_back(std::isfinite(static_cast<T>(value)) ? static_cast<T>(value) : T{0});
    }
    return samples;
}

RC_GTEST_PROP(FloatUnits, ComeBack, ()) {
    check_round_trip(arbitrary_samples<float>());
    check_round_trip(arbitrary_samples<double>());
}

RC_GTEST_PROP(FloatUnits, AnyBytesAreSafe, (const std::vector<std::uint8_t>& tails, const std::vector<std::uint64_t>& numbers)) {
    const Units units{*rc::gen::inRange(-40000, 40000), false};
    std::vector<double> samples(numbers.size());
    (void)join_tails<double>(numbers, std::as_bytes(std::span(tails)), units, samples);
    from_units<double>(numbers, units, samples);
}

TEST(FloatUnits, AreAsLargeAsTheyCanBe) {
    const auto units = [](std::vector<float> samples) { return units_of<float>(samples).value(); };
    EXPECT_EQ(units({1, 2, 1000}).exponent, 0);
    EXPECT_TRUE(units({1, 2, 1000}).exact);
    EXPECT_EQ(units({0.5F, -384, 0}).exponent, -1);
    EXPECT_EQ(units({0.1F, 1, 0}).exponent, -23);  // the last place of 1
    EXPECT_FALSE(units({0.1F, 1, 0}).exact);
    EXPECT_FALSE(units({-0.0F, 1}).exact);
    EXPECT_FALSE(units_of<float>(std::vector{std::numeric_limits<float>::infinity(), 1.0F}));
    EXPECT_FALSE(units_of<float>(std::vector{1.0F, std::numeric_limits<float>::quiet_NaN()}));
}

TEST(FloatUnits, ExtremesAndZeros) {
    using Limits = std::numeric_limits<double>;
    check_round_trip<double>({Limits::lowest(), Limits::max(), 0, -0.0, Limits::denorm_min(), -Limits::denorm_min(), Limits::min()});
    check_round_trip<double>({Limits::denorm_min(), -Limits::denorm_min(), Limits::min(), 3 * Limits::denorm_min()});
    check_round_trip<float>({std::numeric_limits<float>::lowest(), std::numeric_limits<float>::max(), 0, -0.0F, 1e-45F, 1e-38F, -1e-38F});
    check_round_trip<float>({-0.0F, 0});
}

}  // namespace
}  // namespace isoatlas
