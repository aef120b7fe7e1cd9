// f = k0 + k1 x + k2 y + k3 z + k4 xy + k5 xz + k6 yz + k7 xyz. At a critical point X = f_yz, Y = f_xz, Z = f_xy satisfy
// X = -q/A, Y = -q/B, Z = -q/C with q = +-sqrt(-ABC); XYZ = q > 0 is the saddle at which Highs join.
//
// The value is found where f is flat: at a point that lies within `radius` of the saddle f differs from the saddle's value by
// Z dx dy + Y dx dz + X dy dz + k7 dx dy dz, so a position to 14 digits gives the value to 28 (docs/theory/6-interior.md#rounded-once).
#include "critical/body_saddle.h"

#include <algorithm>
#include <cmath>

#include "base/error_free.h"
#include "base/target_clones.h"
#include "critical/trilinear.h"
#include "field/rounding.h"

namespace isoatlas {
namespace {

using Vector = std::array<double, 3>;

/// The cell relative to corner 0, upside down for a saddle that joins Lows.
struct Polynomial {
    std::array<TwoDoubles, 8> k;  // k[0] is not used
    double max = 0;               // the greatest |corner - corner 0|

    Polynomial(const CellValues& v, SaddleKind kind) {
        std::array<TwoDoubles, 8> w;
        for (int i = 0; i < 8; ++i) {
            w[i] = kind == SaddleKind::joins_highs ? two_difference(v[i], v[0]) : two_difference(v[0], v[i]);
            max = std::max(max, std::abs(w[i].high));
        }
        const auto minus = [](TwoDoubles a, TwoDoubles b) { return a + TwoDoubles{-b.high, -b.low}; };
        const TwoDoubles xy = minus(minus(w[3], w[1]), w[2]), xz = minus(minus(w[5], w[1]), w[4]), yz = minus(minus(w[6], w[2]), w[4]);
        const TwoDoubles xyz = minus(minus(minus(w[7], w[6]), xy), minus(w[5], w[4]));
        k = {w[0], w[1], w[2], w[4], xy, xz, yz, xyz};
    }
};

enum class Found { no, perhaps, yes };

struct FirstGuess {
    Found found;
    Vector position;
};

FirstGuess first_guess(const Polynomial& polynomial) {
    std::array<double, 8> high{};
    for (int i = 0; i < 8; ++i) high[i] = polynomial.k[i].high;
    const auto [k0, k1, k2, k3, k4, k5, k6, k7] = high;
    const double a = k1 * k7 - k4 * k5, b = k2 * k7 - k4 * k6, c = k3 * k7 - k5 * k6;
    const double error = 0x1p-46 * polynomial.max * polynomial.max;
    if (!(std::abs(a) > error && std::abs(b) > error && std::abs(c) > error)) return {Found::perhaps, {}};
    const double q2 = -(a * b * c);
    if (!(q2 > 0)) return {Found::no, {}};
    return {Found::yes, saddle_position(high, {a, b, c}, std::sqrt(q2))};
}

/// A point near the saddle, and a proof of how near (Newton-Kantorovich).
struct Near {
    Vector position;
    double radius;     // the saddle lies within this distance along each axis; negative: not proved
    double curvature;  // |X| + |Y| + |Z| there
};

Near newton_step(const Polynomial& polynomial, const Vector& p, Vector& next) {
    const auto k = [&](int i) { return polynomial.k[i].high; };
    const auto [x, y, z] = p;
    const double fyz = k(6) + k(7) * x, fxz = k(5) + k(7) * y, fxy = k(4) + k(7) * z;
    const Vector slope{k(1) + k(4) * y + k(5) * z + k(7) * y * z, k(2) + k(4) * x + k(6) * z + k(7) * x * z,
                       k(3) + k(5) * x + k(6) * y + k(7) * x * y};
    const double error = 0x1p-46 * polynomial.max, min = 0x1p-20 * polynomial.max;  // of slopes; of second derivatives
    const Vector second{fyz, fxz, fxy};
    const double all = std::abs(fyz) + std::abs(fxz) + std::abs(fxy);
    double radius = 0, inverse = 0;  // |step|, |H^-1|
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const double twice = 2 * second[b] * second[c];
        next[a] = p[a] + (second[a] * slope[a] - second[b] * slope[b] - second[c] * slope[c]) / twice;
        double bound = 0;
        for (int i = 0; i < 3; ++i) bound += std::abs(second[i]) * (std::abs(slope[i]) + error);
        radius = std::max(radius, bound / std::abs(twice));
        inverse = std::max(inverse, all / std::abs(twice));
    }
    const bool is_safe = fyz * fxz * fxy > 0 && std::min({std::abs(fyz), std::abs(fxz), std::abs(fxy)}) > min &&
                         inverse * 2 * std::abs(k(7)) * radius < 0.25;
    return {p, is_safe ? 2.1 * radius : -1, all};
}

Near close_in(const Polynomial& polynomial, Vector position) {
    Near near{position, -1, 0};
    for (int step = 0; step < 4; ++step) {
        Vector next{};
        near = newton_step(polynomial, position, next);
        if (near.radius >= 0 && near.radius < 0x1p-38) break;
        position = next;
    }
    return near;
}

Found is_inside(const Near& near) {
    if (!(near.radius >= 0)) return Found::perhaps;
    const auto [low, high] = std::minmax_element(near.position.begin(), near.position.end());
    if (*low - near.radius > 0 && *high + near.radius < 1) return Found::yes;
    return *low + near.radius < 0 || *high - near.radius > 1 ? Found::no : Found::perhaps;
}

/// f at a point minus corner 0, to twice the precision.
template <class Product>
inline TwoDoubles rise_at(const Polynomial& polynomial, const Vector& p) {
    const auto& k = polynomial.k;
    const auto [x, y, z] = p;
    const TwoDoubles in_x = k[1] + times<Product>(k[4] + times<Product>(k[7], z), y) + times<Product>(k[5], z);
    return times<Product>(in_x, x) + times<Product>(k[2] + times<Product>(k[6], z), y) + times<Product>(k[3], z);
}

ISOATLAS_FUSED TwoDoubles rise_fused(const Polynomial& polynomial, const Vector& p) { return rise_at<FusedProduct>(polynomial, p); }

/// Rounded down, or kUndecided.
double rounded_value(const Polynomial& polynomial, const Near& near, double corner, SaddleKind kind) {
    TwoDoubles rise = kHasFused ? rise_fused(polynomial, near.position) : rise_at<PlainProduct>(polynomial, near.position);
    if (kind == SaddleKind::joins_lows) rise = {-rise.high, -rise.low};
    const TwoDoubles first = two_sum(corner, rise.high), sum = two_sum(first.high, first.low + rise.low);
    const double flatness = near.radius * near.radius * (near.curvature + 10 * near.radius * polynomial.max);
    const double error = 1.5 * flatness + 0x1p-90 * polynomial.max + 0x1p-104 * std::abs(sum.high);
    return rounded_down_or_undecided(sum, error);
}

double clamped(double x) { return std::isnan(x) ? 0.5 : std::clamp(x, 0x1p-30, 1 - 0x1p-30); }

/// Are products of six values, and rounding errors of them, neither too large nor too small for doubles?
bool is_moderate(double max, double corner) { return max > 0x1p-120 && max < 0x1p120 && std::abs(corner) < 0x1p500; }

std::optional<BodySaddle> exact_saddle(const CellValues& value, SaddleKind kind, const Vector& guess) {
    if (!exactly_has_saddle(value, kind)) return std::nullopt;
    const Vector position{clamped(guess[0]), clamped(guess[1]), clamped(guess[2])};
    return BodySaddle{exact_saddle_value(value, kind, interpolate(value, position)), position};
}

}  // namespace

double interpolate(const CellValues& v, const std::array<double, 3>& p) {
    const auto between = [](double low, double high, double t) { return low * (1 - t) + high * t; };
    const double y0 = between(between(v[0], v[1], p[0]), between(v[2], v[3], p[0]), p[1]);
    const double y1 = between(between(v[4], v[5], p[0]), between(v[6], v[7], p[0]), p[1]);
    return between(y0, y1, p[2]);
}

std::optional<BodySaddle> body_saddle(const CellValues& value, SaddleKind kind) {
    const Polynomial polynomial(value, kind);
    constexpr Vector kMiddle{0.5, 0.5, 0.5};
    if (!is_moderate(polynomial.max, value[0])) return exact_saddle(value, kind, kMiddle);
    const FirstGuess guess = first_guess(polynomial);
    if (guess.found == Found::no) return std::nullopt;
    if (guess.found == Found::perhaps) return exact_saddle(value, kind, kMiddle);
    const Near near = close_in(polynomial, guess.position);
    const Found inside = is_inside(near);
    if (inside == Found::no) return std::nullopt;
    if (inside == Found::perhaps) return exact_saddle(value, kind, near.position);
    if (const double rounded = rounded_value(polynomial, near, value[0], kind); !std::isnan(rounded)) {
        return BodySaddle{rounded, near.position};
    }
    return BodySaddle{exact_saddle_value(value, kind, interpolate(value, near.position)), near.position};
}

}  // namespace isoatlas
