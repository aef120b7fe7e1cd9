// Notation: l = low, p, q = the Highs - l, r = l - the lowest Low; s = l + p q / (p + q + r). t = p q / (p + q + r) rounded; what rounding
// took from each step is carried along in a second double. u = 2^-53.
#include "field/face.h"

#include <cmath>

#include "base/error_free.h"
#include "base/target_clones.h"
#include "field/rounding.h"

namespace isoatlas {
namespace {

constexpr double kMin = 0x1p-240, kMax = 0x1p240;  // between these no product underflows or overflows

/// s rounded down, or kUndecided. No branches: loops over it become vector code.
template <class Product>
inline double rounded_or_undecided(const FaceCorners& face) {
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
    const TwoDoubles first = two_sum(face.low, t), s = two_sum(first.high, first.low + remainder / sum.high);
    // Errors of p q, p + q + r, the quotient and the last sums: 10 + 20 + 30 + 60 times u^2 t, and u^2 s.
    const double error = ((remainder == 0) & (inputs_low == 0)) ? 0 : 0x1p-96 * t + 0x1p-104 * std::abs(s.high);
    const double min = p.high < q.high ? p.high : q.high;
    const bool is_moderate = (min >= kMin) & (sum.high <= kMax) & (std::abs(face.low) <= kMax);
    const double value = rounded_down_or_undecided(s, error);
    return min == 0 ? face.low + 0.0 : is_moderate ? value : kUndecided;
}

/// Eight at a time, so that no loop has a remainder.
template <class Product>
inline void round_all(const FaceBatch& faces, double* __restrict value) {
    constexpr std::size_t kTogether = 8;
    const auto [low_1, low_2, high_1, high_2] = faces.columns();
    for (std::size_t first = 0; first < faces.count(); first += kTogether) {
        for (std::size_t i = first; i < first + kTogether; ++i) {
            value[i] = rounded_or_undecided<Product>({low_1[i], low_2[i], high_1[i], high_2[i]});
        }
    }
}

ISOATLAS_FUSED double round_fused(const FaceCorners& face) { return rounded_or_undecided<FusedProduct>(face); }
ISOATLAS_FUSED void round_all_fused(const FaceBatch& faces, double* value) { round_all<FusedProduct>(faces, value); }

}  // namespace

double rounded_face_value(const FaceCorners& face) {
    const double value = kHasFused ? round_fused(face) : rounded_or_undecided<PlainProduct>(face);
    return std::isnan(value) ? exact_face_value(face) : value;
}

void rounded_face_values(const FaceBatch& faces, std::span<double, FaceBatch::kMax> value) {
    kHasFused ? round_all_fused(faces, value.data()) : round_all<PlainProduct>(faces, value.data());
    for (std::size_t i = 0; i < faces.count(); ++i) {
        if (std::isnan(value[i])) value[i] = exact_face_value(faces[i]);
    }
}

}  // namespace isoatlas
