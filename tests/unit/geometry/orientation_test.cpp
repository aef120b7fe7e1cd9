// Orientations beside integers of any size: small integers, where most points lie in planes of others; points moved out of such a plane by
// the last bit of a coordinate; numbers whose products no double holds.
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "geometry/orientation.h"

namespace isoatlas {
namespace {

using Rational = boost::multiprecision::cpp_rational;

int rational_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    std::array<std::array<Rational, 3>, 3> row;
    for (std::size_t i = 0; i < 3; ++i) {
        row[0][i] = Rational(b[i]) - Rational(a[i]);
        row[1][i] = Rational(c[i]) - Rational(a[i]);
        row[2][i] = Rational(d[i]) - Rational(a[i]);
    }
    Rational value = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        value += row[2][i] * (row[0][j] * row[1][k] - row[0][k] * row[1][j]);
    }
    return value.sign();
}

int rational_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
    const Rational value = (Rational(b[0]) - Rational(a[0])) * (Rational(c[1]) - Rational(a[1])) -
                           (Rational(b[1]) - Rational(a[1])) * (Rational(c[0]) - Rational(a[0]));
    return value.sign();
}

/// How many of each answer; a test without zeros would not have looked at what is hard.
struct SeenSigns {
    std::array<int, 3> answers{};
    void check(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        const int sign = rational_orientation(a, b, c, d);
        ASSERT_EQ(orientation(a, b, c, d), sign);
        ASSERT_EQ(orientation(b, a, c, d), -sign);
        ASSERT_EQ(exact_orientation(a, b, c, d), sign);
        ++answers[sign + 1];
        const Vec2 p{a[0], a[1]}, q{b[0], b[1]}, r{c[0], c[1]};
        ASSERT_EQ(orientation(p, q, r), rational_orientation(p, q, r));
        ASSERT_EQ(exact_orientation(p, q, r), rational_orientation(p, q, r));
    }
    void expect_all() const {
        for (const int count : answers) EXPECT_GT(count, 50);
    }
};

TEST(Orientation, TurnsAsTheRightHandDoes) {
    const Vec3 o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    EXPECT_EQ(orientation(o, x, y, z), 1);
    EXPECT_EQ(orientation(o, y, x, z), -1);
    EXPECT_EQ(orientation(o, x, y, x), 0);
    EXPECT_EQ(orientation(Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}), 1);
}

TEST(Orientation, IsExactOnSmallIntegers) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> coordinate(0, 3);
    const auto point = [&] { return Vec3{double(coordinate(random)), double(coordinate(random)), double(coordinate(random))}; };
    SeenSigns seen;
    for (int i = 0; i < 20000; ++i) seen.check(point(), point(), point(), point());
    seen.expect_all();
}

TEST(Orientation, IsExactBesideAPlane) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> coordinate(-100, 100);
    std::uniform_int_distribution<int> step(-1, 1), eighths(0, 8);
    const auto point = [&] { return Vec3{coordinate(random), coordinate(random), coordinate(random)}; };
    SeenSigns seen;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 a = point(), b = point(), c = point();
        const double s = eighths(random) / 8.0, t = eighths(random) / 8.0;
        Vec3 d;
        for (std::size_t k = 0; k < 3; ++k) {
            d[k] = a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]);
            d[k] = std::nextafter(d[k], d[k] + step(random));
        }
        seen.check(a, b, c, d);
    }
    seen.expect_all();
}

TEST(Orientation, IsExactFarFromOneUnit) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> coordinate(-2, 2), exponent(-1074, 1000);
    SeenSigns seen;
    for (int i = 0; i < 3000; ++i) {
        const Vec3 unit{std::ldexp(1.0, exponent(random)), std::ldexp(1.0, exponent(random)), std::ldexp(1.0, exponent(random))};
        const auto point = [&] {
            return Vec3{coordinate(random) * unit[0], coordinate(random) * unit[1],
                        coordinate(random) * unit[2] + coordinate(random) * unit[0]};
        };
        seen.check(point(), point(), point(), point());
    }
    seen.expect_all();
}

TEST(Orientation, IsExactOfMixedMagnitudes) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> exponent(-200, 200);
    std::uniform_int_distribution<int> sign(-1, 1);
    SeenSigns seen;
    for (int i = 0; i < 3000; ++i) {
        const auto number = [&] { return sign(random) * std::exp2(exponent(random)); };
        const auto point = [&] { return Vec3{number(), number(), number()}; };
        seen.check(point(), point(), point(), point());
    }
    seen.expect_all();
}

}  // namespace
}  // namespace isoatlas
