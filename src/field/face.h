// Ambiguous faces and their disambiguation points (docs/theory/1-elements-and-order.md#ambiguous-faces).
//
// Corners a b c d run around the face as in field/cell.h; their voxel numbers ascend a < b < d < c, so comparisons of vertex keys
// (value, voxel number) become comparisons of values that are strict or not.
//
// In the literature: asymptotic decider (Nielson, Hamann, The asymptotic decider: resolving the ambiguity in Marching Cubes, 1991).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>

#include "field/rounding.h"

namespace isoatlas {

enum class Diagonal : signed char { none = -1, ac = 0, bd = 1 };  ///< which diagonal is High

/// Which diagonal lies above the other in the total order: both of its corners above both others; none: the face is not ambiguous.
template <class T>
constexpr Diagonal high_diagonal(T a, T b, T c, T d) {
    if (a > b && a > d && c >= b && c >= d) return Diagonal::ac;
    if (b >= a && b > c && d >= a && d > c) return Diagonal::bd;
    return Diagonal::none;
}

/// The corners of an ambiguous face by their role.
struct FaceCorners {
    double lowest, low, high_1, high_2;  ///< lowest <= low <= high_1, high_2

    FaceCorners(double low_1, double low_2, double high, double other_high)
        : lowest(std::min(low_1, low_2)), low(std::max(low_1, low_2)), high_1(high), high_2(other_high) {}
    FaceCorners(double a, double b, double c, double d, Diagonal highs)
        : FaceCorners(highs == Diagonal::ac ? b : a, highs == Diagonal::ac ? d : c, highs == Diagonal::ac ? a : b,
                      highs == Diagonal::ac ? c : d) {}
    [[nodiscard]] double lowest_high() const { return std::min(high_1, high_2); }
};

struct ApproximateValue {
    double value, error;  ///< error: at most; NaN where a sum overflows, so that no comparison with it is certain
};

/// s = low + p q / (p + q + r) in plain doubles: no cancellation, whatever the samples have in common
/// (docs/theory/1-elements-and-order.md#numbers).
inline ApproximateValue approximate_face_value(const FaceCorners& face) {
    // The latter: more than what is lost where results are denormal. It is none itself: some processors take 150 cycles for a product of
    // it.
    constexpr double kRelative = 0x1p-49, kMin = 0x1p-900;
    const double p = face.high_1 - face.low, q = face.high_2 - face.low, sum = p + q + (face.low - face.lowest);
    return {face.low + p * (q / sum), kRelative * (std::abs(face.low) + p) + (kMin + p * kMin) + 0 * sum};  // p q / sum <= p
}

/// s rounded down (field/rounding.h). Any finite corners. Cost: about 100 flops; a microsecond where twice the precision does not decide.
double rounded_face_value(const FaceCorners& face);

/// Faces whose values are found together, as columns.
class FaceBatch {
public:
    static constexpr std::size_t kMax = 256;

    [[nodiscard]] std::size_t count() const { return count_; }
    /// At most kMax. The Lows in any order: a branch on which is lower is unpredictable, and vector code needs none.
    void add(double low_1, double low_2, double high_1, double high_2) {
        column_[0][count_] = low_1, column_[1][count_] = low_2;
        column_[2][count_] = high_1, column_[3][count_] = high_2;
        ++count_;
    }
    void clear() { count_ = 0; }
    [[nodiscard]] FaceCorners operator[](std::size_t i) const { return {column_[0][i], column_[1][i], column_[2][i], column_[3][i]}; }
    /// low_1, low_2, high_1, high_2; what lies behind count() means nothing.
    [[nodiscard]] std::array<const double*, 4> columns() const {
        return {column_[0].data(), column_[1].data(), column_[2].data(), column_[3].data()};
    }

private:
    std::size_t count_ = 0;
    alignas(64) std::array<std::array<double, kMax>, 4> column_{};
};

/// value[i] = rounded_face_value(faces[i]). Cost: about 30 flops a face, by vectors of the processor.
void rounded_face_values(const FaceBatch& faces, std::span<double, FaceBatch::kMax> value);

/// The same by integers alone. Cost: about a microsecond, a hundred with exponents far apart.
double exact_face_value(const FaceCorners& face);

/// The same of corners of 8 or 16 bits, as (ac - bd) / (a + c - b - d): numerator and denominator are exact.
inline double small_face_value(double a, double b, double c, double d) {
    const double numerator = a * c - b * d, denominator = (a + c) - (b + d), quotient = numerator / denominator;
    const TwoDoubles whole = PlainProduct()(quotient, denominator);
    const double remainder = (numerator - whole.high) - whole.low;
    return denominator > 0 ? (remainder < 0 ? next_below(quotient) : quotient + 0.0)
                           : (remainder > 0 ? next_below(quotient) : quotient + 0.0);
}

template <class T>
inline constexpr bool kIsSmall = std::is_integral_v<T> && sizeof(T) <= 2;

/// Value of the face point: the saddle of the bilinear interpolant, rounded down; between the highest Low and the lowest High.
template <class T>
inline double disambiguation_value(T a, T b, T c, T d, Diagonal highs) {
    if constexpr (kIsSmall<T>) return small_face_value(a, b, c, d);
    return rounded_face_value(FaceCorners(a, b, c, d, highs));
}

/// At isovalue tau: are the two Highs of a 4-hit face joined across it? (tau <= s joins the Highs.)
/// The corners' classes at tau decide that the face is 4-hit; the diagonal is the High one.
template <class T>
inline bool highs_are_joined(T a, T b, T c, T d, Diagonal highs, double tau) {
    const ApproximateValue s = approximate_face_value(FaceCorners(a, b, c, d, highs));
    if (s.value - tau > s.error) return true;
    if (tau - s.value > s.error) return false;
    return disambiguation_value(a, b, c, d, highs) >= tau;
}

}  // namespace isoatlas
