// Rational numbers, and the doubles below them. Slow and obvious.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

namespace oracle {

using Rational = boost::multiprecision::cpp_rational;

/// The greatest double at most x. |x| is at most that of some double.
inline double greatest_double_at_most(const Rational& x) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    const double guess = x.convert_to<double>();
    double below = std::isfinite(guess) ? guess : std::copysign(std::numeric_limits<double>::max(), guess);
    while (Rational(below) > x) below = std::nextafter(below, -kInfinite);
    for (double above = std::nextafter(below, kInfinite); std::isfinite(above) && Rational(above) <= x;
         above = std::nextafter(below, kInfinite)) {
        below = above;
    }
    return below + 0.0;
}

}  // namespace oracle
