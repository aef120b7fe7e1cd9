#include "critical/earlier_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "critical/trilinear.h"

namespace isoatlas {
namespace {

/// The values times a power of two, so that products of six of them neither overflow nor vanish. exponent: the power that was taken away.
std::array<double, 8> scaled(const std::array<double, 8>& value, int& exponent) {
    double max = 0;
    for (const double v : value) max = std::max(max, std::abs(v));
    exponent = max == 0 || (max > 1e-30 && max < 1e30) ? 0 : std::ilogb(max);
    std::array<double, 8> result = value;
    if (exponent == 0) return result;
    for (double& v : result) v = std::ldexp(v, -exponent);
    return result;
}

/// A symmetry of the cube: corner k of the transformed cell is corner image(k), new axis a is old axis order[a], seen from corner `origin`.
struct Symmetry {
    int origin;
    std::array<int, 3> order;

    [[nodiscard]] int image(int k) const {
        int corner = origin;
        for (int a = 0; a < 3; ++a) corner ^= (k >> a & 1) << order[a];
        return corner;
    }
    [[nodiscard]] std::array<double, 8> of(const std::array<double, 8>& value) const {
        std::array<double, 8> rotated;
        for (int k = 0; k < 8; ++k) rotated[k] = value[image(k)];
        return rotated;
    }
};

/// The symmetry that makes mirrored and permuted copies of a cell the same: its highest corner first, then the highest neighbours of that.
Symmetry canonical_symmetry(const std::array<double, 8>& value) {
    std::optional<Symmetry> best;
    std::array<double, 8> max{};
    const double top = *std::max_element(value.begin(), value.end());
    for (int origin = 0; origin < 8; ++origin) {
        if (value[origin] != top) continue;
        std::array<int, 3> order{0, 1, 2};
        const auto higher = [&](int a, int b) { return value[origin ^ 1 << a] > value[origin ^ 1 << b]; };
        do {
            if (higher(order[1], order[0]) || higher(order[2], order[1])) continue;
            const Symmetry symmetry{origin, order};
            const std::array<double, 8> rotated = symmetry.of(value);
            if (!best || rotated > max) best = symmetry, max = rotated;
        } while (std::next_permutation(order.begin(), order.end()));
    }
    return *best;
}

std::optional<std::array<double, 3>> position_inside(const CellValues& value) {
    const std::array<double, 8> k = trilinear_coefficients(value);
    const double a = k[1] * k[7] - k[4] * k[5], b = k[2] * k[7] - k[4] * k[6], c = k[3] * k[7] - k[5] * k[6];
    const double q2 = -(a * b * c);
    if (!(q2 > 0)) return std::nullopt;
    const std::array<double, 3> position = saddle_position(k, {a, b, c}, std::sqrt(q2));
    if (!std::ranges::all_of(position, [](double x) { return x > 0 && x < 1; })) return std::nullopt;
    return position;
}

std::optional<BodySaddle> earlier_saddle(const std::array<double, 8>& value) {
    int exponent = 0;
    const std::array<double, 8> at_hand = scaled(value, exponent);
    const Symmetry symmetry = canonical_symmetry(at_hand);
    const std::array<double, 8> rotated = symmetry.of(at_hand);
    const std::optional<std::array<double, 3>> position = position_inside(rotated);
    if (!position) return std::nullopt;
    BodySaddle saddle{std::ldexp(interpolate(rotated, *position), exponent), {}};
    for (int a = 0; a < 3; ++a) {
        const int axis = symmetry.order[a];
        saddle.position[axis] = symmetry.origin >> axis & 1 ? 1 - (*position)[a] : (*position)[a];
    }
    return saddle;
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
    mark_ambiguous_faces(cell);
    for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) {
        const int f = std::countr_zero(rest);
        const std::array<int, 4>& c = kFaceCorners[f];
        const Diagonal highs = cell.bd_high >> f & 1 ? Diagonal::bd : Diagonal::ac;
        cell.face_value[f] = earlier_face_value(cell.value[c[0]], cell.value[c[1]], cell.value[c[2]], cell.value[c[3]], highs);
    }
    const unsigned types = default_face_types(cell);
    int exponent = 0;
    const CellValues value = scaled(cell.value, exponent);
    const DisagreeingFaces faces = disagreeing_faces(cell, types, [&value](int f) { return side_slope(value, f).sum; });
    std::optional<BodySaddle> low, high;
    if (faces.openings != 0) low = earlier_saddle(cell.value);
    if (faces.closings != 0) high = earlier_saddle(negated(cell.value));
    if (high) high->value = -high->value;
    return bodies_of_saddles(cell, faces, low, high, tunnel_height);
}

}  // namespace isoatlas
