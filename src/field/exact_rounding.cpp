#include "field/exact_rounding.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "field/face.h"
#include "field/order.h"

namespace isoatlas {
namespace {

constexpr std::uint64_t kSignBit = std::uint64_t{1} << 63;

/// The double of ordered_bits (field/order.h).
double of_ordered_bits(std::uint64_t ordered) { return std::bit_cast<double>((ordered & kSignBit) != 0 ? ordered ^ kSignBit : ~ordered); }

/// Corners low, p, q, p + q + r in the same unit: s = (low d + p q) / d.
struct FaceIntegers {
    cpp_int numerator, denominator;
    int exponent;
};

FaceIntegers face_integers(const FaceCorners& face) {
    const CommonExponent corner = with_common_exponent(std::array{face.lowest, face.low, face.high_1, face.high_2});
    const cpp_int p = corner.integers[2] - corner.integers[1], q = corner.integers[3] - corner.integers[1];
    const cpp_int sum = p + q + (corner.integers[1] - corner.integers[0]);
    return {corner.integers[1] * sum + p * q, sum, corner.exponent};
}

}  // namespace

BinaryFraction binary_fraction(double value) {
    if (value == 0) return {0, 0};
    int exponent = 0;
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    mantissa /= std::int64_t{1} << zeros;
    return {mantissa, exponent - 53 + zeros};
}

CommonExponent with_common_exponent(std::span<const double> values) {
    std::vector<BinaryFraction> fractions;
    int min = std::numeric_limits<int>::max();
    for (const double value : values) {
        fractions.push_back(binary_fraction(value));
        if (value != 0) min = std::min(min, fractions.back().exponent);
    }
    CommonExponent result{{}, min == std::numeric_limits<int>::max() ? 0 : min};
    for (BinaryFraction& fraction : fractions) {
        const int shift = fraction.mantissa == 0 ? 0 : fraction.exponent - result.exponent;
        result.integers.push_back(fraction.mantissa << shift);
    }
    return result;
}

// Doubles by their ordered bits: low is reached in the end, high is not.
double rounded_down_by_comparisons(double guess, const std::function<int(const BinaryFraction&)>& sign) {
    const std::uint64_t first = ordered_bits(std::numeric_limits<double>::lowest());
    const std::uint64_t infinite = ordered_bits(std::numeric_limits<double>::infinity());
    const auto is_reached = [&](std::uint64_t ordered) { return sign(binary_fraction(of_ordered_bits(ordered))) >= 0; };
    std::uint64_t low = ordered_bits(guess), high = low;
    for (std::uint64_t step = 1; low > first && !is_reached(low); step *= 2) high = low, low -= std::min(step, low - first);
    if (high == low) {
        high = low + 1;
        for (std::uint64_t step = 1; high < infinite && is_reached(high); step *= 2) low = high, high += std::min(step, infinite - high);
    }
    while (high - low > 1) {
        const std::uint64_t middle = low + (high - low) / 2;
        (is_reached(middle) ? low : high) = middle;
    }
    return of_ordered_bits(low) + 0.0;
}

double exact_face_value(const FaceCorners& face) {
    const FaceIntegers s = face_integers(face);
    double guess = approximate_face_value(face).value;
    if (!(guess >= face.low && guess <= face.lowest_high())) guess = face.low;
    return rounded_down_by_comparisons(guess, [&](const BinaryFraction& m) {
        const int shift = m.exponent - s.exponent;
        const cpp_int left = shift < 0 ? cpp_int(s.numerator << -shift) : s.numerator;
        const cpp_int right = (shift > 0 ? cpp_int(m.mantissa << shift) : m.mantissa) * s.denominator;
        return left.compare(right);
    });
}

}  // namespace isoatlas
