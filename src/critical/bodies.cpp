// Notation: a cut of the cell is the rank of its lowest High element. The class of an element: 1 High, 0 Low.
#include "critical/bodies.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "critical/body_saddle.h"
#include "critical/tunnels.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr int kElements = 14;  // of a cell: corners 0..7, face f is 8 + f

/// A cell by the ranks of its elements, so that it can be turned upside down.
struct RankedCell {
    std::array<double, 8> value;
    std::array<double, 6> face_value;
    std::array<int, kElements> rank;  ///< of an element; faces that are not ambiguous have none
    std::array<int, kElements> at;    ///< element of a rank
    int count;
    unsigned ambiguous, bd_high;

    [[nodiscard]] double value_of(int element) const { return element < 8 ? value[element] : face_value[element - 8]; }
    [[nodiscard]] int pattern(int cut) const {
        int high = 0;
        for (int k = 0; k < 8; ++k) high |= (rank[k] >= cut) << k;
        return high;
    }
    [[nodiscard]] int joined(int cut) const {
        int faces = 0;
        for (unsigned rest = ambiguous; rest != 0; rest &= rest - 1) {
            const int f = std::countr_zero(rest);
            faces |= (rank[8 + f] >= cut) << f;
        }
        return faces;
    }
    [[nodiscard]] std::array<int, 2> highs(int f) const {
        const int first = bd_high >> f & 1 ? 1 : 0;
        return {kFaceCorners[f][first], kFaceCorners[f][first + 2]};
    }
    [[nodiscard]] std::array<int, 2> lows(int f) const {
        const int first = bd_high >> f & 1 ? 0 : 1;
        return {kFaceCorners[f][first], kFaceCorners[f][first + 2]};
    }
    /// Does the point of f coincide in value with a corner of f?
    [[nodiscard]] bool is_tied(int f) const {
        return std::any_of(kFaceCorners[f].begin(), kFaceCorners[f].end(), [&](int k) { return value[k] == face_value[f]; });
    }
};

RankedCell ranked(const CellElements& cell) {
    RankedCell result{cell.value, cell.face_value, {}, {}, 0, cell.ambiguous, cell.bd_high};
    for (int k = 0; k < 8; ++k) result.at[result.count++] = k;
    for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) result.at[result.count++] = 8 + std::countr_zero(rest);
    std::sort(result.at.begin(), result.at.begin() + result.count, [&](int p, int q) { return element_below(cell, p, q); });
    for (int r = 0; r < result.count; ++r) result.rank[result.at[r]] = r;
    return result;
}

RankedCell upside_down(const RankedCell& cell) {
    RankedCell result = cell;
    for (double& v : result.value) v = -v;
    for (double& v : result.face_value) v = -v;
    for (int r = 0; r < cell.count; ++r) {
        result.at[r] = cell.at[cell.count - 1 - r];
        result.rank[result.at[r]] = r;
    }
    result.bd_high ^= cell.ambiguous;
    return result;
}

/// The corners of the region of a corner.
unsigned region_of(const std::array<std::uint8_t, 8>& region, int corner) {
    unsigned corners = 0;
    for (int k = 0; k < 8; ++k) corners |= unsigned{region[k] == region[corner]} << k;
    return corners;
}

/// The two regions that a tunnel joins, followed upwards.
struct Tunnel {
    unsigned a, b;

    /// What is left of them at a higher cut; false when one is gone or falls apart, or when no tunnel fits between them.
    [[nodiscard]] bool follow(const RankedCell& cell, int cut, int low_corner) {
        const int pattern = cell.pattern(cut);
        const std::array<std::uint8_t, 8> region = cell_regions(pattern, cell.joined(cut));
        const unsigned left_a = a & static_cast<unsigned>(pattern), left_b = b & static_cast<unsigned>(pattern);
        if (left_a == 0 || left_b == 0) return false;
        if (region_of(region, std::countr_zero(left_a)) != left_a || region_of(region, std::countr_zero(left_b)) != left_b) return false;
        if (!tunnel_fits(left_a, left_b, region_of(region, low_corner))) return false;
        a = left_a, b = left_b;
        return true;
    }
};

/// The body point above the closing face f of a cell whose saddle is known; none when it would not lie above f.
std::optional<BodyPoint> place(const RankedCell& cell, const BodySaddle& saddle, int f) {
    const std::array<int, 2> highs = cell.highs(f), lows = cell.lows(f);
    const int above = cell.rank[8 + f] + 1;
    const std::array<std::uint8_t, 8> region = cell_regions(cell.pattern(above), cell.joined(above));
    Tunnel tunnel{region_of(region, highs[0]), region_of(region, highs[1])};
    if (!tunnel.follow(cell, above, lows[0])) return std::nullopt;
    double value = saddle.value;
    for (int r = above; r < cell.count && cell.value_of(cell.at[r]) < value; ++r) {
        if (tunnel.follow(cell, r + 1, lows[0])) continue;
        value = cell.value_of(cell.at[r]);  // it cannot lie higher
    }
    if (!(value > cell.face_value[f])) return std::nullopt;
    return BodyPoint{value, saddle.position, f, std::countr_zero(tunnel.a), std::countr_zero(tunnel.b), lows[0]};
}

/// B1 of a cell with a saddle. faces: those whose Highs are joined in truth but not by default. Untied faces first, then the highest.
std::optional<BodyPoint> opening_point(const RankedCell& cell, const BodySaddle& saddle, unsigned faces) {
    std::array<int, 6> order{};
    int count = 0;
    for (unsigned rest = faces; rest != 0; rest &= rest - 1) order[count++] = std::countr_zero(rest);
    std::sort(order.begin(), order.begin() + count, [&](int f, int g) {
        if (cell.is_tied(f) != cell.is_tied(g)) return cell.is_tied(g);
        return cell.rank[8 + f] > cell.rank[8 + g];
    });
    for (int i = 0; i < count; ++i) {
        if (saddle.value > cell.face_value[order[i]]) return place(cell, saddle, order[i]);
    }
    return std::nullopt;
}

std::array<double, 8> negated(std::array<double, 8> value) {
    for (double& v : value) v = -v;
    return value;
}

}  // namespace

double side_sign(const std::array<double, 8>& v, int f) {
    const std::array<int, 4>& corner = kFaceCorners[f];
    const int across = 1 << kFaceAxes[f / 2].normal;
    const double a = v[corner[0]], b = v[corner[1]], c = v[corner[2]], d = v[corner[3]];
    const double da = v[corner[0] ^ across] - a, db = v[corner[1] ^ across] - b;
    const double dc = v[corner[2] ^ across] - c, dd = v[corner[3] ^ across] - d;
    const double at_a = (c - b) * (c - d) * da, at_c = (a - d) * (a - b) * dc;
    const double at_b = (a - d) * (c - d) * db, at_d = (c - b) * (a - b) * dd;
    return (at_a + at_c) + (at_b + at_d);  // the same bits for a turned or mirrored face
}

double tunnel_height_of(Interpolant interpolant, double tunnel_height) {
    if (!(tunnel_height >= 0)) {
        throw Error(ErrorKind::usage, {.what = "the tunnel height is not a number of at least 0",
                                       .next = "give the height of the lowest tunnel to leave out"});
    }
    return interpolant == Interpolant::trilinear ? tunnel_height : std::numeric_limits<double>::infinity();
}

CellBodies bodies_of_cell(const CellElements& cell, unsigned default_types, double tunnel_height) {
    unsigned openings = 0, closings = 0;
    int exponent = 0;
    const std::array<double, 8> value = scaled(cell.value, exponent);
    for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) {
        const int f = std::countr_zero(rest);
        const double sign = side_sign(value, f);
        const bool joined = default_types >> f & 1;
        if (!joined && sign > 0) openings |= 1U << f;
        if (joined && sign < 0) closings |= 1U << f;
    }
    CellBodies bodies;
    const std::optional<BodySaddle> low = openings != 0 ? body_saddle(cell.value) : std::nullopt;
    const std::optional<BodySaddle> high = closings != 0 ? body_saddle(negated(cell.value)) : std::nullopt;
    if (!low && !high) return bodies;
    const RankedCell upright = ranked(cell);
    if (low) bodies.opening = opening_point(upright, *low, openings);
    if (high) bodies.closing = opening_point(upside_down(upright), *high, closings);
    if (bodies.closing) bodies.closing->value = -bodies.closing->value;
    if (bodies.opening && bodies.closing) {
        const bool in_order = bodies.closing->value >= bodies.opening->value &&
                              upright.rank[8 + bodies.closing->face] > upright.rank[8 + bodies.opening->face];
        if (!in_order) bodies.opening.reset();
    }
    for (std::optional<BodyPoint>* body : {&bodies.opening, &bodies.closing}) {
        if (*body && std::abs((*body)->value - cell.face_value[(*body)->face]) <= tunnel_height) body->reset();
        if (*body) bodies.exceptional |= 1U << (*body)->face;
    }
    return bodies;
}

}  // namespace isoatlas
