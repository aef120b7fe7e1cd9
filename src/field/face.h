// Ambiguous faces and their disambiguation points (theory.md sections 1 and 9).
//
// Corners a b c d run around the face as in field/cell.h; their voxel numbers ascend a < b < d < c, so comparisons of vertex keys
// (value, voxel number) become comparisons of values that are strict or not.
#pragma once

namespace isoatlas {

enum class Diagonal : signed char { none = -1, ac = 0, bd = 1 };  ///< which diagonal is High

/// Which diagonal lies above the other in the total order: both of its corners above both others; none: the face is not ambiguous.
template <class T>
constexpr Diagonal high_diagonal(T a, T b, T c, T d) {
    if (a > b && a > d && c >= b && c >= d) return Diagonal::ac;
    if (b >= a && b > c && d >= a && d > c) return Diagonal::bd;
    return Diagonal::none;
}

/// Value of the face point: the saddle of the bilinear interpolant, clamped between the highest Low and the lowest High.
/// Without contraction, and written so that turning or mirroring the face changes no bit. Exact in order and equality for 8 and 16 bit
/// samples.
template <class T>
constexpr double disambiguation_value(T corner_a, T corner_b, T corner_c, T corner_d, Diagonal highs) {
    const double a = static_cast<double>(corner_a), b = static_cast<double>(corner_b);
    const double c = static_cast<double>(corner_c), d = static_cast<double>(corner_d);
    const bool ac = highs == Diagonal::ac;
    const double lows_1 = ac ? b : a, lows_2 = ac ? d : c, highs_1 = ac ? a : b, highs_2 = ac ? c : d;
    const double low = lows_1 > lows_2 ? lows_1 : lows_2;
    const double high = highs_1 < highs_2 ? highs_1 : highs_2;
    double s = (a * c - b * d) / ((a + c) - (b + d));
    if (!(s >= low)) s = low;
    if (s > high) s = high;
    return s;
}

/// At isovalue tau: are the two Highs of a 4-hit face joined across it? (tau <= s joins the Highs.)
/// The corners' classes at tau decide that the face is 4-hit; the diagonal is the High one.
template <class T>
constexpr bool highs_are_joined(T a, T b, T c, T d, Diagonal highs, double tau) {
    return disambiguation_value(a, b, c, d, highs) >= tau;
}

}  // namespace isoatlas
