// Rounding of saddle values (field/rounding.h) by comparisons with integers of any size: where double-double arithmetic does not decide.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <functional>
#include <span>
#include <vector>

namespace isoatlas {

using boost::multiprecision::cpp_int;

/// mantissa * 2^exponent.
struct BinaryFraction {
    cpp_int mantissa;
    int exponent;
};

/// A finite double exactly; the mantissa is odd or 0.
BinaryFraction binary_fraction(double value);

/// Doubles as integers: value i = integers[i] * 2^exponent.
struct CommonExponent {
    std::vector<cpp_int> integers;
    int exponent;
};
CommonExponent with_common_exponent(std::span<const double> values);

/// The greatest double at most a number that is known by comparisons. sign(m): that of number - m. guess: near the number, finite.
/// Cost: a few comparisons, more the worse the guess: two for each doubling of its distance.
double rounded_down_by_comparisons(double guess, const std::function<int(const BinaryFraction&)>& sign);

}  // namespace isoatlas
