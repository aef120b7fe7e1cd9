#include "critical/earlier_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace isoatlas {
namespace {

using Coefficients = std::array<double, 8>;

Coefficients coefficients(const std::array<double, 8>& v) {
    return {v[0],
            v[1] - v[0],
            v[2] - v[0],
            v[4] - v[0],
            v[3] - v[1] - v[2] + v[0],
            v[5] - v[1] - v[4] + v[0],
            v[6] - v[2] - v[4] + v[0],
            v[7] - v[6] - v[5] - v[3] + v[4] + v[2] + v[1] - v[0]};
}

/// (root - k) / k7 without cancellation: numerator is that of (root^2 - k^2) / k7, which divides by a.
double coordinate(double root, double k, double k7, double numerator, double a) {
    return root * k <= 0 ? (root - k) / k7 : -numerator / (a * (root + k));
}

/// The values times a power of two, so that products of six of them neither overflow nor vanish. exponent: the power that was taken away.
std::array<double, 8> scaled(const std::array<double, 8>& value, int& exponent) {
    double most = 0;
    for (const double v : value) most = std::max(most, std::abs(v));
    exponent = most == 0 || (most > 1e-30 && most < 1e30) ? 0 : std::ilogb(most);
    std::array<double, 8> result = value;
    if (exponent == 0) return result;
    for (double& v : result) v = std::ldexp(v, -exponent);
    return result;
}

/// A way to look at a cell: corner k of the turned cell is corner image(k), new axis a is old axis order[a], seen from corner `origin`.
struct Turn {
    int origin;
    std::array<int, 3> order;

    [[nodiscard]] int image(int k) const {
        int corner = origin;
        for (int a = 0; a < 3; ++a) corner ^= (k >> a & 1) << order[a];
        return corner;
    }
    [[nodiscard]] std::array<double, 8> of(const std::array<double, 8>& value) const {
        std::array<double, 8> turned;
        for (int k = 0; k < 8; ++k) turned[k] = value[image(k)];
        return turned;
    }
};

/// The turn after which mirrored and permuted copies of a cell are the same: its highest corner first, then the highest neighbours of that.
Turn canonical_turn(const std::array<double, 8>& value) {
    std::optional<Turn> best;
    std::array<double, 8> most{};
    const double top = *std::max_element(value.begin(), value.end());
    for (int origin = 0; origin < 8; ++origin) {
        if (value[origin] != top) continue;
        std::array<int, 3> order{0, 1, 2};
        const auto higher = [&](int a, int b) { return value[origin ^ 1 << a] > value[origin ^ 1 << b]; };
        do {
            if (higher(order[1], order[0]) || higher(order[2], order[1])) continue;
            const Turn turn{origin, order};
            const std::array<double, 8> turned = turn.of(value);
            if (!best || turned > most) best = turn, most = turned;
        } while (std::next_permutation(order.begin(), order.end()));
    }
    return *best;
}

std::optional<std::array<double, 3>> saddle_position(const std::array<double, 8>& value) {
    const auto [k0, k1, k2, k3, k4, k5, k6, k7] = coefficients(value);
    const double a = k1 * k7 - k4 * k5, b = k2 * k7 - k4 * k6, c = k3 * k7 - k5 * k6;
    const double q2 = -(a * b * c);
    if (!(q2 > 0)) return std::nullopt;
    const double q = std::sqrt(q2);
    const std::array<double, 3> position{coordinate(-q / a, k6, k7, k2 * k3 * k7 - k2 * k5 * k6 - k3 * k4 * k6 + k1 * k6 * k6, a),
                                         coordinate(-q / b, k5, k7, k1 * k3 * k7 - k1 * k5 * k6 - k3 * k4 * k5 + k2 * k5 * k5, b),
                                         coordinate(-q / c, k4, k7, k1 * k2 * k7 - k2 * k4 * k5 - k1 * k4 * k6 + k3 * k4 * k4, c)};
    for (const double x : position) {
        if (!(x > 0 && x < 1)) return std::nullopt;
    }
    return position;
}

std::optional<BodySaddle> earlier_saddle(const std::array<double, 8>& value) {
    int exponent = 0;
    const std::array<double, 8> at_hand = scaled(value, exponent);
    const Turn turn = canonical_turn(at_hand);
    const std::array<double, 8> turned = turn.of(at_hand);
    const std::optional<std::array<double, 3>> position = saddle_position(turned);
    if (!position) return std::nullopt;
    BodySaddle saddle{std::ldexp(interpolate(turned, *position), exponent), {}};
    for (int a = 0; a < 3; ++a) {
        const int axis = turn.order[a];
        saddle.position[axis] = turn.origin >> axis & 1 ? 1 - (*position)[a] : (*position)[a];
    }
    return saddle;
}

/// The sign of G, rounded.
double earlier_side_sign(const CellValues& v, int f) {
    const std::array<int, 4>& corner = kFaceCorners[f];
    const int across = 1 << kFaceAxes[f / 2].normal;
    const double a = v[corner[0]], b = v[corner[1]], c = v[corner[2]], d = v[corner[3]];
    const double da = v[corner[0] ^ across] - a, db = v[corner[1] ^ across] - b;
    const double dc = v[corner[2] ^ across] - c, dd = v[corner[3] ^ across] - d;
    const double at_a = (c - b) * (c - d) * da, at_c = (a - d) * (a - b) * dc;
    const double at_b = (a - d) * (c - d) * db, at_d = (c - b) * (a - b) * dd;
    return (at_a + at_c) + (at_b + at_d);
}

CellValues negated(CellValues value) {
    for (double& v : value) v = -v;
    return value;
}

}  // namespace

double earlier_face_value(double a, double b, double c, double d, Diagonal highs) {
    const FaceCorners face(a, b, c, d, highs);
    const double s = (a * c - b * d) / ((a + c) - (b + d));
    return s >= face.low ? std::min(s, face.lowest_high()) : face.low;
}

CellBodies earlier_bodies(CellElements& cell, double tunnel_height) {
    find_ambiguous_faces(cell);
    for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) {
        const int f = std::countr_zero(rest);
        const std::array<int, 4>& c = kFaceCorners[f];
        const Diagonal highs = cell.bd_high >> f & 1 ? Diagonal::bd : Diagonal::ac;
        cell.face_value[f] = earlier_face_value(cell.value[c[0]], cell.value[c[1]], cell.value[c[2]], cell.value[c[3]], highs);
    }
    const unsigned types = default_face_types(cell);
    int exponent = 0;
    const CellValues value = scaled(cell.value, exponent);
    DisagreeingFaces faces;
    for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) {
        const int f = std::countr_zero(rest);
        const double sign = earlier_side_sign(value, f);
        const bool joined = types >> f & 1;
        if (!joined && sign > 0) faces.openings |= 1U << f;
        if (joined && sign < 0) faces.closings |= 1U << f;
    }
    std::optional<BodySaddle> low, high;
    if (faces.openings != 0) low = earlier_saddle(cell.value);
    if (faces.closings != 0) high = earlier_saddle(negated(cell.value));
    if (high) high->value = -high->value;
    return bodies_of_saddles(cell, faces, low, high, tunnel_height);
}

}  // namespace isoatlas
