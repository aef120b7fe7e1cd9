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

[[gnu::always_inline]] inline SideSlope slope_of(const CellValues& v, int f) {
    const std::array<int, 4>& corner = kFaceCorners[f];
    const int across = 1 << kFaceAxes[f / 2].normal;
    const double a = v[corner[0]], b = v[corner[1]], c = v[corner[2]], d = v[corner[3]];
    const double da = v[corner[0] ^ across] - a, db = v[corner[1] ^ across] - b;
    const double dc = v[corner[2] ^ across] - c, dd = v[corner[3] ^ across] - d;
    const double at_a = (c - b) * (c - d) * da, at_c = (a - d) * (a - b) * dc;
    const double at_b = (a - d) * (c - d) * db, at_d = (c - b) * (a - b) * dd;
    return {(at_a + at_c) + (at_b + at_d), std::abs(at_a) + std::abs(at_b) + std::abs(at_c) + std::abs(at_d)};
}

bool are_integers(const CellValues& v) {
    return std::all_of(v.begin(), v.end(),
                       [](double x) { return std::abs(x) < 0x1p60 && x == static_cast<double>(static_cast<std::int64_t>(x)); });
}

[[gnu::always_inline]] inline int sign_of(const SideSlope& slope, const CellValues& v, int f) {
    const auto [sum, terms] = slope;
    const bool is_certain = std::abs(sum) > 0x1p-49 * terms && terms > 0x1p-900 && terms < 0x1p1000;
    if (!is_certain && !(terms < 0x1p53 && are_integers(v))) return exact_side_sign(v, f);  // of small integers the sum is exact
    return sum > 0 ? 1 : sum < 0 ? -1 : 0;
}

/// The High corners and faces of a cell at one cut.
struct CellCut {
    int pattern = 0, joined = 0;

    void lower(int element) { element < 8 ? pattern &= ~(1 << element) : joined &= ~(1 << (element - 8)); }
};

/// A cell as it stands or upside down: values negated, Highs and Lows exchanged. Elements: corners 0..7, face f is 8 + f.
class CellView {
public:
    CellView(const CellElements& cell, bool is_upside_down) : cell_(cell), is_upside_down_(is_upside_down) {}

    [[nodiscard]] double value(int element) const { return is_upside_down_ ? -stored(element) : stored(element); }
    [[nodiscard]] bool is_above(int element, int other) const {
        if (stored(element) != stored(other)) return (stored(element) > stored(other)) != is_upside_down_;
        return element_below(cell_, other, element) != is_upside_down_;
    }
    /// The cut just above face f.
    [[nodiscard]] CellCut above_face(int f) const {
        CellCut cut;
        for (int k = 0; k < 8; ++k) cut.pattern |= is_above(k, 8 + f) << k;
        for (unsigned rest = cell_.ambiguous & ~(1U << f); rest != 0; rest &= rest - 1) {
            const int g = std::countr_zero(rest);
            cut.joined |= is_above(8 + g, 8 + f) << g;
        }
        return cut;
    }
    [[nodiscard]] std::array<int, 2> diagonal(int f, bool high) const {
        const int first = ((cell_.bd_high >> f & 1) != 0) != is_upside_down_ ? (high ? 1 : 0) : (high ? 0 : 1);
        return {kFaceCorners[f][first], kFaceCorners[f][first + 2]};
    }
    /// Does the point of f coincide in value with a corner of f?
    [[nodiscard]] bool is_tied(int f) const {
        return std::any_of(kFaceCorners[f].begin(), kFaceCorners[f].end(), [&](int k) { return cell_.value[k] == cell_.face_value[f]; });
    }

private:
    [[nodiscard]] double stored(int element) const { return element < 8 ? cell_.value[element] : cell_.face_value[element - 8]; }

    const CellElements& cell_;
    bool is_upside_down_;
};

/// High elements of a cut with a value below some limit, ascending.
struct Ascending {
    std::array<int, 14> element;
    int count = 0;

    Ascending(const CellView& cell, const CellCut& cut, double limit) {
        for (int e = 0; e < 14; ++e) {
            const bool is_high = e < 8 ? cut.pattern >> e & 1 : cut.joined >> (e - 8) & 1;
            if (is_high && cell.value(e) < limit) element[count++] = e;
        }
        std::sort(element.begin(), element.begin() + count, [&](int p, int q) { return cell.is_above(q, p); });
    }
};

/// The body point above the closing face f of a cell whose saddle is known; none when it would not lie above f. The two regions that meet
/// in f are followed upwards: the body point may lie where both are still in one piece and a tunnel fits between them.
std::optional<BodyPoint> place(const CellView& cell, const BodySaddle& saddle, int f) {
    const int low = cell.diagonal(f, false)[0];
    const std::array<int, 2> highs = cell.diagonal(f, true);
    CellCut cut = cell.above_face(f);
    const TunnelShape* shape = &tunnel_shape(cut.pattern, cut.joined, true);
    unsigned a = shape->a, b = shape->b;
    const auto apart = [&](int p, int q) { return (a >> p & b >> q & 1) != 0; };
    if ((shape->ring >> low & 1) == 0 || !(apart(highs[0], highs[1]) || apart(highs[1], highs[0]))) return std::nullopt;
    double value = saddle.value;
    const Ascending passed(cell, cut, value);
    for (int i = 0; i < passed.count; ++i) {
        cut.lower(passed.element[i]);
        shape = &tunnel_shape(cut.pattern, cut.joined, true);
        const unsigned left_a = a & static_cast<unsigned>(cut.pattern), left_b = b & static_cast<unsigned>(cut.pattern);
        if (left_a == 0 || !shape->joins(left_a, left_b) || (shape->ring >> low & 1) == 0) {
            value = cell.value(passed.element[i]);  // it cannot lie higher
            break;
        }
        a = left_a, b = left_b;
    }
    if (!(value > cell.value(8 + f))) return std::nullopt;
    return BodyPoint{value, saddle.position, f, std::countr_zero(a), std::countr_zero(b), low};
}

/// B1 of a cell with a saddle. faces: those whose Highs are joined in truth but not by default. Untied faces first, then the highest.
std::optional<BodyPoint> opening_point(const CellView& cell, const BodySaddle& saddle, unsigned faces) {
    std::array<int, 6> order{};
    int count = 0;
    for (unsigned rest = faces; rest != 0; rest &= rest - 1) order[count++] = std::countr_zero(rest);
    std::sort(order.begin(), order.begin() + count, [&](int f, int g) {
        if (cell.is_tied(f) != cell.is_tied(g)) return cell.is_tied(g);
        return cell.is_above(8 + f, 8 + g);
    });
    for (int i = 0; i < count; ++i) {
        if (saddle.value > cell.value(8 + order[i])) return place(cell, saddle, order[i]);
    }
    return std::nullopt;
}

}  // namespace

SideSlope side_slope(const CellValues& v, int f) { return slope_of(v, f); }

int side_sign(const CellValues& v, int f) { return sign_of(slope_of(v, f), v, f); }

double tunnel_height_of(Interpolant interpolant, double tunnel_height) {
    if (!(tunnel_height >= 0)) {
        throw Error(ErrorKind::usage, {.what = "the tunnel height is not a number of at least 0",
                                       .next = "give the height of the lowest tunnel to leave out"});
    }
    return interpolant == Interpolant::trilinear ? tunnel_height : std::numeric_limits<double>::infinity();
}

DisagreeingFaces disagreeing_faces(const CellElements& cell, unsigned default_types) {
    if (cell.has_small_integers) return disagreeing_faces(cell, default_types, [&cell](int f) { return slope_of(cell.value, f).sum; });
    return disagreeing_faces(cell, default_types, [&cell](int f) { return sign_of(slope_of(cell.value, f), cell.value, f); });
}

CellBodies bodies_of_cell(const CellElements& cell, const DisagreeingFaces& faces, double tunnel_height) {
    std::optional<BodySaddle> low, high;
    if (faces.openings != 0) low = body_saddle(cell.value, SaddleKind::joins_highs);
    if (faces.closings != 0) high = body_saddle(cell.value, SaddleKind::joins_lows);
    return bodies_of_saddles(cell, faces, low, high, tunnel_height);
}

CellBodies bodies_of_saddles(const CellElements& cell, const DisagreeingFaces& faces, const std::optional<BodySaddle>& low,
                             std::optional<BodySaddle> high, double tunnel_height) {
    CellBodies bodies;
    if (!low && !high) return bodies;
    if (high) high->value = -high->value;
    const CellView upright(cell, false), upside_down(cell, true);
    if (low) bodies.opening = opening_point(upright, *low, faces.openings);
    if (high) bodies.closing = opening_point(upside_down, *high, faces.closings);
    if (bodies.closing) bodies.closing->value = -bodies.closing->value;
    if (bodies.opening && bodies.closing) {
        const bool in_order =
            bodies.closing->value >= bodies.opening->value && upright.is_above(8 + bodies.closing->face, 8 + bodies.opening->face);
        if (!in_order) bodies.opening.reset();
    }
    for (std::optional<BodyPoint>* body : {&bodies.opening, &bodies.closing}) {
        if (*body && std::abs((*body)->value - cell.face_value[(*body)->face]) <= tunnel_height) body->reset();
        if (*body) bodies.exceptional |= 1U << (*body)->face;
    }
    return bodies;
}

}  // namespace isoatlas
