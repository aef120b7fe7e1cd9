// Notation: f = k0 + k1 x + k2 y + k3 z + k4 xy + k5 xz + k6 yz + k7 xyz, the corners relative to corner 0 (k0 = 0), negated for a saddle
// that joins Lows. A = k1 k7 - k4 k5, B = k2 k7 - k4 k6, C = k3 k7 - k5 k6, X = f_yz = -q / A, q = sqrt(-ABC). The value y of the saddle is
// the smaller root of k7^2 y^2 - 2 M y + R, where
//   M = 2 k4 k5 k6 - k7 S,  S = k1 k6 + k2 k5 + k3 k4,  R = S^2 + 4 k1 k2 k3 k7 - 4 (k1 k2 k5 k6 + k1 k3 k4 k6 + k2 k3 k4 k5):
// the polynomial is Cayley's hyperdeterminant of the cell minus y. Proofs: docs/theory/6-interior.md#rounded-once.
#include "critical/exact_cell.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error_free.h"
#include "critical/trilinear.h"
#include "field/cell.h"
#include "field/exact_rounding.h"

namespace isoatlas {
namespace {

__extension__ using Small = __int128;
constexpr int kSmallBits = 39;  // of corners relative to the first: the polynomials of degree three below stay under 2^123

template <class Int>
using Corners = std::array<Int, 8>;

template <class Int>
int sign_of(const Int& value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// One axis of a saddle: is its coordinate above 0? k: of this axis, other..., a: the axis's A. The axes y and z by exchanging the k.
template <class Int>
bool is_above_zero(const Int& k1, const Int& k2, const Int& k3, const Int& k4, const Int& k5, const Int& k6, const Int& k7, const Int& a) {
    const int sign_x = -sign_of(a);  // of X = k7 x + k6
    if (sign_x * sign_of(k6) <= 0) return sign_x * sign_of(k7) > 0;
    // k7 x = X - k6, times X + k6: x = -(...) / (A (X + k6)), where A and X + k6 have opposite signs.
    return k2 * (k3 * k7 - k5 * k6) + k6 * (k1 * k6 - k3 * k4) > 0;
}

template <class Int>
bool is_inside_from_origin(const Corners<Int>& corner) {
    const auto [k0, k1, k2, k3, k4, k5, k6, k7] = trilinear_coefficients(corner);
    const Int a = k1 * k7 - k4 * k5, b = k2 * k7 - k4 * k6, c = k3 * k7 - k5 * k6;
    if (sign_of(a) * sign_of(b) * sign_of(c) >= 0) return false;  // q^2 = -ABC
    return is_above_zero(k1, k2, k3, k4, k5, k6, k7, a) && is_above_zero(k2, k1, k3, k4, k6, k5, k7, b) &&
           is_above_zero(k3, k1, k2, k5, k6, k4, k7, c);
}

/// Strictly inside: above 0 along each axis, seen from corner 0 and from corner 7.
template <class Int>
bool has_saddle(const Corners<Int>& corner) {
    if (!is_inside_from_origin(corner)) return false;
    Corners<Int> mirrored = corner;
    std::reverse(mirrored.begin(), mirrored.end());
    return is_inside_from_origin(mirrored);
}

template <class Int>
int side_sign_of(const Corners<Int>& v, int f) {
    const std::array<int, 4>& corner = kFaceCorners[f];
    const int across = 1 << kFaceAxes[f / 2].normal;
    const Int &a = v[corner[0]], &b = v[corner[1]], &c = v[corner[2]], &d = v[corner[3]];
    const Int da = v[corner[0] ^ across] - a, db = v[corner[1] ^ across] - b;
    const Int dc = v[corner[2] ^ across] - c, dd = v[corner[3] ^ across] - d;
    const Int ab = a - b, ad = a - d, cb = c - b, cd = c - d;
    return sign_of(Int(cb * cd * da + ad * cd * db + ad * ab * dc + cb * ab * dd));
}

/// Corners relative to the first, in a common unit; none where that takes more bits.
std::optional<Corners<Small>> small_corners(const CellValues& value) {
    double max = 0;
    for (const double v : value) max = std::max(max, std::abs(v - value[0]));
    if (!(max > 0x1p-900 && max < 0x1p900)) return std::nullopt;
    const int exponent = std::ilogb(max) + 1 - kSmallBits;
    Corners<Small> corner{};
    for (int k = 0; k < 8; ++k) {
        const TwoDoubles difference = two_difference(value[k], value[0]);
        const double scaled = std::ldexp(difference.high, -exponent), whole = std::trunc(scaled);
        if (difference.low != 0 || whole != scaled) return std::nullopt;
        corner[k] = static_cast<std::int64_t>(whole);
    }
    return corner;
}

template <class Decide>
auto decided(const CellValues& value, const Decide& decide) {
    if (const std::optional<Corners<Small>> corner = small_corners(value)) return decide(*corner);
    const CommonExponent large = with_common_exponent(value);
    Corners<cpp_int> corner;
    std::copy(large.integers.begin(), large.integers.end(), corner.begin());
    return decide(corner);
}

template <class Int>
Corners<Int> turned_for(Corners<Int> corner, SaddleKind kind) {
    if (kind == SaddleKind::joins_lows) {
        for (Int& v : corner) v = -v;
    }
    return corner;
}

/// k7^2 y^2 - 2 M y + R.
struct SaddlePolynomial {
    cpp_int k7_squared, m, r;

    explicit SaddlePolynomial(const Corners<cpp_int>& corner) {
        const auto [k0, k1, k2, k3, k4, k5, k6, k7] = trilinear_coefficients(corner);
        const cpp_int s = k1 * k6 + k2 * k5 + k3 * k4;
        k7_squared = k7 * k7;
        m = 2 * k4 * k5 * k6 - k7 * s;
        r = s * s + 4 * k1 * k2 * k3 * k7 - 4 * (k1 * k2 * k5 * k6 + k1 * k3 * k4 * k6 + k2 * k3 * k4 * k5);
    }

    /// Sign of the smaller root minus t / 2^shift. At most that root: the polynomial is not negative there and falls.
    [[nodiscard]] int smaller_root_minus(const cpp_int& t, int shift) const {
        const cpp_int scaled_m = m << shift;
        const int sign = sign_of(cpp_int(k7_squared * t * t - 2 * scaled_m * t + (r << 2 * shift)));
        const bool falls = k7_squared * t <= scaled_m;
        return sign < 0 || !falls ? -1 : sign;
    }
};

}  // namespace

int exact_side_sign(const CellValues& value, int f) {
    return decided(value, [f](const auto& corner) { return side_sign_of(corner, f); });
}

bool exactly_has_saddle(const CellValues& value, SaddleKind kind) {
    return decided(value, [kind](const auto& corner) { return has_saddle(turned_for(corner, kind)); });
}

double exact_saddle_value(const CellValues& value, SaddleKind kind, double guess) {
    const CommonExponent common = with_common_exponent(value);
    const int symmetry = kind == SaddleKind::joins_lows ? -1 : 1;
    Corners<cpp_int> corner;
    for (int k = 0; k < 8; ++k) corner[k] = symmetry * (common.integers[k] - common.integers[0]);
    const SaddlePolynomial polynomial(corner);
    const auto [lowest, highest] = std::minmax_element(value.begin(), value.end());
    if (!(guess >= *lowest && guess <= *highest)) guess = *lowest;
    return rounded_down_by_comparisons(guess, [&](const BinaryFraction& other) {
        const int up = std::max(0, other.exponent - common.exponent), down = std::max(0, common.exponent - other.exponent);
        const cpp_int t = symmetry * ((other.mantissa << up) - (common.integers[0] << down));  // in units of 2^(common.exponent - down)
        return symmetry * polynomial.smaller_root_minus(t, down);
    });
}

}  // namespace isoatlas
