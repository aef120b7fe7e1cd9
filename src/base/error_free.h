// Sums and products of doubles without error: the rounded result and what rounding took away.
//
// In the literature: error-free transformations (Knuth 1969; Dekker, Numer. Math. 18, 1971; Shewchuk, Discrete Comput. Geom. 18, 1997).
// Needs rounding to nearest and no contraction (cmake/warnings.cmake). Sums are exact while they do not overflow; products while factors
// and product stay between 2^-960 and 2^990.
#pragma once

#include <cmath>

namespace isoatlas {

/// high + low, where high is the sum rounded to double.
struct TwoDoubles {
    double high, low;
};

inline TwoDoubles two_sum(double a, double b) {
    const double sum = a + b, of_b = sum - a;
    return {sum, (a - (sum - of_b)) + (b - of_b)};
}

inline TwoDoubles two_difference(double a, double b) { return two_sum(a, -b); }

/// Of |a| >= |b| or a == 0.
inline TwoDoubles fast_two_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

/// Products without fused multiply-add. The bits are those of FusedProduct.
struct PlainProduct {
    TwoDoubles operator()(double a, double b) const {
        constexpr double kSplitter = 134217729;  // 2^27 + 1
        const double product = a * b;
        const double a_scaled = kSplitter * a, a_high = a_scaled - (a_scaled - a), a_low = a - a_high;
        const double b_scaled = kSplitter * b, b_high = b_scaled - (b_scaled - b), b_low = b - b_high;
        return {product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)};
    }
};

/// In functions with ISOATLAS_FUSED (base/target_clones.h): elsewhere slow.
struct FusedProduct {
    TwoDoubles operator()(double a, double b) const {
        const double product = a * b;
        return {product, __builtin_fma(a, b, -product)};
    }
};

// Double-double arithmetic: relative errors below 2^-102 of the operands' magnitudes.

inline TwoDoubles operator+(TwoDoubles a, TwoDoubles b) {
    const TwoDoubles sum = two_sum(a.high, b.high);
    return fast_two_sum(sum.high, sum.low + (a.low + b.low));
}

template <class Product>
inline TwoDoubles times(TwoDoubles a, double b) {
    const TwoDoubles product = Product()(a.high, b);
    return fast_two_sum(product.high, product.low + a.low * b);
}

}  // namespace isoatlas
