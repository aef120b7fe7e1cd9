// Integers of 64 bits as float64: those that float64 has, compared with the arithmetic of long double, and no others.
#include "formats/common/wide_integers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

template <class Integer>
constexpr WideInteger kType = std::is_signed_v<Integer> ? WideInteger::int64 : WideInteger::uint64;

/// nullopt: refused.
template <class Integer>
std::optional<double> read_as_double(Integer integer, std::vector<std::uint64_t> missing = {}) {
    std::array<Integer, 3> numbers{0, integer, 1};
    try {
        doubles_of_integers(std::as_writable_bytes(std::span(numbers)), {.type = kType<Integer>, .missing = std::move(missing)}, "v.npy");
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
        EXPECT_NE(error.text().what.find(std::to_string(integer)), std::string::npos);
        EXPECT_EQ(error.text().file, "v.npy");
        return std::nullopt;
    }
    std::array<double, 3> values{};
    std::memcpy(values.data(), numbers.data(), sizeof values);
    EXPECT_EQ(values[0], 0);
    EXPECT_EQ(values[2], 1);
    return values[1];
}

template <class Integer>
void expect_exact_or_refused(Integer integer) {
    static_assert(std::numeric_limits<long double>::digits >= 64);
    const auto rounded = static_cast<double>(integer);
    const bool is_exact = static_cast<long double>(rounded) == static_cast<long double>(integer);
    const std::optional<double> value = read_as_double(integer);
    EXPECT_EQ(value.has_value(), is_exact) << integer;
    EXPECT_EQ(value.value_or(rounded), rounded);
}

template <class Integer>
void expect_of_many() {
    using Limits = std::numeric_limits<Integer>;
    for (int bit = 0; bit < Limits::digits; ++bit) {
        const auto power = static_cast<Integer>(Integer{1} << bit);
        for (const int step : {-3, -2, -1, 0, 1, 2, 3}) {
            expect_exact_or_refused(static_cast<Integer>(static_cast<std::uint64_t>(power) + static_cast<std::uint64_t>(step)));
            expect_exact_or_refused(static_cast<Integer>(static_cast<std::uint64_t>(step) - static_cast<std::uint64_t>(power)));
        }
    }
    for (const Integer end : {Limits::min(), Limits::max()}) expect_exact_or_refused(end);
    std::mt19937_64 random(std::random_device{}());
    for (int i = 0; i < 10000; ++i) expect_exact_or_refused(static_cast<Integer>(random() << random() % 16));
}

TEST(WideIntegers, AreExactOrRefused) {
    expect_of_many<std::int64_t>();
    expect_of_many<std::uint64_t>();
}

TEST(WideIntegers, MissingOnesAreNotANumber) {
    constexpr std::int64_t kFill = -9223372036854775806;  // of NetCDF
    EXPECT_FALSE(read_as_double(kFill));
    EXPECT_TRUE(std::isnan(read_as_double(kFill, {static_cast<std::uint64_t>(kFill)}).value()));
    EXPECT_EQ(read_as_double(std::numeric_limits<std::int64_t>::min(), {static_cast<std::uint64_t>(kFill)}), -0x1p63);
    EXPECT_TRUE(std::isnan(read_as_double(std::uint64_t{5}, {7, 5}).value()));
}

TEST(WideIntegers, OtherSamplesStay) {
    std::array<std::byte, 3> bytes{std::byte{1}, std::byte{2}, std::byte{3}};
    doubles_of_integers(bytes, {}, "v.npy");
    EXPECT_EQ(bytes, (std::array<std::byte, 3>{std::byte{1}, std::byte{2}, std::byte{3}}));
}

}  // namespace
}  // namespace isoatlas
