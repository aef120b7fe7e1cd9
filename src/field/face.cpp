// Notation: l = low, p, q = the Highs - l, r = l - the lowest Low; s = l + p q / (p + q + r). t = p q / (p + q + r) rounded; what rounding
// took from each step is carried along in a second double. u = 2^-53.
#include "field/face.h"

#include <algorithm>

#include "base/wide.h"
#include "field/error_free.h"
#include "field/rounding.h"

namespace isoatlas {
namespace {

constexpr double kLeast = 0x1p-240, kMost = 0x1p240;  // between these no product underflows or overflows

/// s = sum.high + sum.low up to `error`; 0: exactly.
struct Saddle {
    TwoDoubles sum;
    double error;
};

template <class Product>
inline Saddle saddle_of(const FaceCorners& face) {
    const TwoDoubles p = two_difference(face.high_1, face.low), q = two_difference(face.high_2, face.low);
    const TwoDoubles r = two_difference(face.low, face.lowest);
    const TwoDoubles pq_sum = two_sum(p.high, q.high), sum = two_sum(pq_sum.high, r.high);
    const double inputs_low = std::abs(p.low) + std::abs(q.low) + std::abs(r.low) + std::abs(pq_sum.low) + std::abs(sum.low);
    const double sum_low = (pq_sum.low + sum.low) + (p.low + q.low + r.low);
    const TwoDoubles product = Product()(p.high, q.high);
    const double product_low = product.low + (p.high * q.low + p.low * q.high);
    const double t = product.high / sum.high;
    const TwoDoubles whole = Product()(t, sum.high);
    // product.high - whole.high - whole.low is a double: the remainder of a division.
    const double remainder = ((product.high - whole.high) - whole.low) + (product_low - t * sum_low);
    const TwoDoubles s = two_sum(face.low, t);
    if (remainder == 0 && inputs_low == 0) return {s, 0};
    const double correction = s.low + remainder / sum.high;
    // Errors of p q, p + q + r, the quotient and the last sums: 10 + 20 + 30 + 60 times u^2 t, and u^2 s.
    return {two_sum(s.high, correction), 0x1p-96 * t + 0x1p-104 * std::abs(s.high)};
}

bool is_extreme(const FaceCorners& face, double p, double q) {
    return !(std::min(p, q) >= kLeast && p + q + (face.low - face.lowest) <= kMost && std::abs(face.low) <= kMost);
}

ISOATLAS_FUSED Saddle saddle_fused(const FaceCorners& face) { return saddle_of<FusedProduct>(face); }

}  // namespace

double rounded_face_value(const FaceCorners& face) {
    const double p = face.high_1 - face.low, q = face.high_2 - face.low;
    if (p == 0 || q == 0) return face.low + 0.0;
    if (is_extreme(face, p, q)) return exact_face_value(face);
    const Saddle s = kHasFused ? saddle_fused(face) : saddle_of<PlainProduct>(face);
    const std::optional<double> rounded = rounded_down_if_certain(s.sum, s.error);
    return rounded ? *rounded : exact_face_value(face);
}

}  // namespace isoatlas
