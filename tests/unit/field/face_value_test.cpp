// Values of face points against rational arithmetic, for corners of every kind that doubles have.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "field/face.h"
#include "oracle/rational.h"

namespace isoatlas {
namespace {

using oracle::Rational;
using Four = std::array<double, 4>;  // ascending

Rational exact_saddle(const Four& v) {  // the Highs v[2], v[3] on one diagonal
    const Rational a(v[3]), b(v[1]), c(v[2]), d(v[0]);
    return (a * c - b * d) / (a + c - b - d);
}

class FaceValues : public testing::Test {
protected:
    double uniform() { return std::uniform_real_distribution<>(0, 1)(random_); }
    double scaled(int exponents) { return std::ldexp(uniform() - 0.5, std::uniform_int_distribution<>(-exponents, exponents)(random_)); }
    std::uint64_t below(std::uint64_t n) { return random_() % n; }

    void expect_exact(const std::function<double()>& sample, int trials = 2000) {
        for (int i = 0; i < trials; ++i) {
            Four v{sample(), sample(), sample(), sample()};
            std::sort(v.begin(), v.end());
            if (v[1] == v[2]) continue;
            const FaceCorners face(v[3], v[1], v[2], v[0], Diagonal::ac);
            const Rational exact = exact_saddle(v);
            const double expected = oracle::greatest_double_at_most(exact);
            ASSERT_EQ(rounded_face_value(face), expected) << v[0] << " " << v[1] << " " << v[2] << " " << v[3];
            ASSERT_EQ(exact_face_value(face), expected);
            const ApproximateValue estimate = approximate_face_value(face);
            if (std::isfinite(estimate.error)) {
                ASSERT_LE(abs(Rational(estimate.value) - exact), Rational(estimate.error));
            }
            for (const double tau : {expected, std::nextafter(expected, 2 * v[3]), v[1], v[2]}) {
                ASSERT_EQ(highs_are_joined(v[3], v[1], v[2], v[0], Diagonal::ac, tau), exact >= Rational(tau));
            }
        }
    }
    std::mt19937_64 random_{20261122};
};

TEST_F(FaceValues, OfSmallIntegers) {
    expect_exact([&] { return static_cast<double>(below(7)); });
    expect_exact([&] { return static_cast<double>(below(65536)) - 32768; });
}
TEST_F(FaceValues, OfFloats) {
    expect_exact([&] { return static_cast<double>(static_cast<float>(uniform())); });
    expect_exact([&] { return static_cast<double>(static_cast<float>(scaled(100))); });
}
TEST_F(FaceValues, OfIntegersOf32Bits) {
    expect_exact([&] { return static_cast<double>(below(std::uint64_t{1} << 32)); });
    expect_exact([&] { return 2147483648.0 - static_cast<double>(below(5) * below(1000000000)); });
}
TEST_F(FaceValues, OfDoubles) {
    expect_exact([&] { return uniform(); });
    expect_exact([&] { return scaled(20); });
    expect_exact([&] { return scaled(1000); }, 300);
}
TEST_F(FaceValues, WithAnOffset) {
    for (const double offset : {1e3, 1e6, 1e9, 1e12, 1e15}) {
        expect_exact([&] { return uniform() + offset; }, 500);
        expect_exact([&] { return static_cast<double>(below(4)) - offset; }, 500);
    }
}
TEST_F(FaceValues, OneUnitInTheLastPlaceApart) {
    expect_exact([&] { return 1 + static_cast<double>(below(6)) * 0x1p-52; });
    expect_exact([&] { return -1 + static_cast<double>(below(6)) * 0x1p-53; });
}
TEST_F(FaceValues, OfDenormals) {
    expect_exact([&] { return (static_cast<double>(below(9)) - 4) * std::numeric_limits<double>::denorm_min(); });
    expect_exact([&] { return (uniform() - 0.5) * 0x1p-1022; }, 500);
}
TEST_F(FaceValues, AsLargeAsDoublesGet) {
    expect_exact([&] { return (uniform() - 0.5) * 2 * std::numeric_limits<double>::max(); }, 500);
    expect_exact([&] { return below(2) == 0 ? 1e308 : -1e308 * uniform(); }, 500);
}

// Vectors of the processor give what one face alone gives.
TEST_F(FaceValues, FoundTogetherAreTheSame) {
    for (std::size_t count = 0; count <= FaceBatch::kMax; count = 2 * count + 1 + below(3)) {
        FaceBatch batch;
        std::vector<double> expected;
        while (batch.count() < count) {
            Four v{};
            for (double& x : v)
                x = below(3) == 0   ? static_cast<double>(below(4))
                    : below(9) == 0 ? scaled(1000)
                                    : uniform() + 1e6 * static_cast<double>(below(2));
            std::sort(v.begin(), v.end());
            if (v[1] == v[2]) continue;
            const bool is_first = below(2) == 0;
            batch.add(v[is_first ? 0 : 1], v[is_first ? 1 : 0], v[3], v[2]);
            expected.push_back(rounded_face_value(FaceCorners(v[3], v[0], v[2], v[1], Diagonal::ac)));
        }
        std::array<double, FaceBatch::kMax> found{};
        rounded_face_values(batch, found);
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(found[i], expected[i]) << i << " of " << count;
    }
}

// Corners of 8 and 16 bits have a formula of their own.
TEST_F(FaceValues, OfShortSamplesAreTheSame) {
    for (int i = 0; i < 20000; ++i) {
        std::array<std::uint16_t, 4> v{};
        for (std::uint16_t& x : v) x = static_cast<std::uint16_t>(below(i % 2 == 0 ? 65536 : 8));
        for (const auto& [a, b, c, d] : {std::array{v[0], v[1], v[2], v[3]}}) {
            const Diagonal highs = high_diagonal(a, b, c, d);
            if (highs == Diagonal::none) continue;
            const double wide = disambiguation_value<double>(a, b, c, d, highs);
            ASSERT_EQ(disambiguation_value(a, b, c, d, highs), wide) << a << " " << b << " " << c << " " << d;
        }
    }
}

}  // namespace
}  // namespace isoatlas
