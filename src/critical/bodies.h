// Body points: where the trilinear interpolant joins two regions of a cell through its interior (docs/theory/6-interior.md#body-points).
//
// Face F of a cell: Highs a, c and Lows b, d; a' b' c' d' lie behind them on the opposite face. The sign of G (side_sign) decides whether
// the Highs of F are joined inside the cell just under F (G > 0) or its Lows are (G < 0). Where it differs from the default type of F
// (critical/faces.h) the cell holds a body point:
//   opening  B1 above F: two High regions A, C are joined there by a tunnel through the interior, and F only closes the ring of Lows
//            around the tunnel. Default type Lows, in truth Highs.
//   closing  B2 below F: the same of the negated cell.
// A cell has at most one of each. Between F and its body point the tunnel is open.
//
// In the literature: body saddles (Natarajan, On generating topologically consistent isosurfaces, 1994) and the interior test of Marching
// Cubes 33 (Chernyaev 1995).
#pragma once

#include <array>
#include <bit>
#include <optional>

#include "critical/body_saddle.h"
#include "critical/faces.h"
#include "isoatlas/interpolant.h"

namespace isoatlas {

/// D^2 times the derivative of the trilinear interpolant into the cell at the saddle of face f, rounded, and the sum of the absolute values
/// of its four terms: rounding is less than 2^-49 of that. The sum has the same bits for a rotated or mirrored face.
struct SideSlope {
    double sum, terms;
};
SideSlope side_slope(const CellValues& value, int f);

/// Sign (-1, 0, 1) of the derivative of the trilinear interpolant into the cell at the saddle of its ambiguous face f. Exact.
int side_sign(const CellValues& value, int f);

struct BodyPoint {
    double value;
    std::array<double, 3> position;  ///< in the cell, 0..1
    int face;                        ///< its F
    int region_a, region_b;          ///< a corner of each of the two regions it joins (B1: Highs; B2: Lows)
    int ring;                        ///< a corner of the region around the tunnel (B1: a Low of F; B2: a High of F)
};

struct CellBodies {
    std::optional<BodyPoint> opening;  ///< B1: High iff its value >= tau, below every other element of that value
    std::optional<BodyPoint> closing;  ///< B2: above every other element of its value
    unsigned exceptional = 0;          ///< bit f: the type of f in this cell is not the default one
};

/// Ambiguous faces whose sign disagrees with their default type; bit f.
struct DisagreeingFaces {
    unsigned openings = 0;  ///< default Lows, in truth Highs
    unsigned closings = 0;  ///< default Highs, in truth Lows
    [[nodiscard]] bool any() const { return (openings | closings) != 0; }
};

/// sign(f): positive, negative or zero as the derivative into the cell at the saddle of face f.
template <class Sign>
DisagreeingFaces disagreeing_faces(const CellElements& cell, unsigned default_types, const Sign& sign) {
    DisagreeingFaces faces;
    for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) {
        const int f = std::countr_zero(rest);
        const auto slope = sign(f);
        const unsigned joined = default_types >> f & 1;  // branch-free: branches would be unpredictable
        faces.openings |= (unsigned{slope > 0} & ~joined) << f;
        faces.closings |= (unsigned{slope < 0} & joined) << f;
    }
    return faces;
}

/// default_types: of default_face_types. Reads the corners alone. Cost: a few flops a face.
DisagreeingFaces disagreeing_faces(const CellElements& cell, unsigned default_types);

/// The body points of a cell with face values (find_face_values). Those that lie at most tunnel_height from their face are left out: any
/// subset of them makes a consistent topology (docs/theory/6-interior.md#finding-them). Cost: O(1).
CellBodies bodies_of_cell(const CellElements& cell, const DisagreeingFaces& faces, double tunnel_height = 0);

/// The same where the saddles are known: low joins Highs, high joins Lows.
CellBodies bodies_of_saddles(const CellElements& cell, const DisagreeingFaces& faces, const std::optional<BodySaddle>& low,
                             std::optional<BodySaddle> high, double tunnel_height);

/// The same from the default types.
inline CellBodies bodies_of_cell(const CellElements& cell, unsigned default_types, double tunnel_height = 0) {
    return bodies_of_cell(cell, disagreeing_faces(cell, default_types), tunnel_height);
}

/// The tunnel height that stands for an interpolant: faces only means no tunnel however high. Throws Error{usage} unless it is 0 or more.
double tunnel_height_of(Interpolant interpolant, double tunnel_height);

}  // namespace isoatlas
