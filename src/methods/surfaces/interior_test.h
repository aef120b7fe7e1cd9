// The interior test of Marching Cubes 33: does the inside of a cell join two corners of one class that its faces do not join?
//
// In a section of the cell, parallel to two of its faces, the trilinear interpolant is bilinear. Let A, B, C, D be its corners in turn
// minus the isovalue, at height t between the faces. Where F(t) = A C - B D > 0, with A and C of one class, the section joins them, as the
// asymptotic decider says of a face. F is a polynomial of degree two; the test takes the height at which it is greatest.
//
// It joins nothing that is apart, because the section lies in the cell. It misses nothing: say that the inside joins two regions of Highs.
// Then the section through its saddle, between A > 0 and C > 0, has F > 0, and B, D < 0, or the edge of the section between A, B and C, a
// line in two faces of the cell, would join the regions already. Follow F > 0 from there to other heights. No sign changes first: at a zero
// of A or C, F = -B D < 0; at a zero of B or D, again two faces would join the regions. A face at the end is not reached, or it would join
// them. So F > 0 is an interval inside the cell, with its greatest value where the test looks, and all three axes show it. Lows likewise.
//
// In the literature: Chernyaev, Marching Cubes 33: construction of topologically correct isosurfaces, 1995.
#pragma once

#include <array>
#include <optional>

#include "field/cell.h"

namespace isoatlas {

/// Ends of edges that a section joins: corners of a cell, both High or both Low.
struct JoinedCorners {
    int a, b;
};

/// A cell between two opposite faces: a section at any height.
class CellSections {
public:
    /// values: of its corners minus the isovalue. axis: across the sections.
    CellSections(const std::array<double, 8>& values, int axis) {
        const auto [axis1, axis2, normal] = kFaceAxes[static_cast<std::size_t>(2 - axis)];
        const std::array<int, 4> around{0, 1 << axis1, 1 << axis1 | 1 << axis2, 1 << axis2};
        for (std::size_t i = 0; i < 4; ++i) {
            from_[i] = around[i], to_[i] = around[i] | 1 << normal;
            first_[i] = values[static_cast<std::size_t>(from_[i])];
            rise_[i] = values[static_cast<std::size_t>(to_[i])] - first_[i];
        }
    }
    /// diagonal: 0 for A and C, 1 for B and D. Equality with the isovalue is High.
    [[nodiscard]] std::optional<JoinedCorners> joins(std::size_t diagonal) const {
        const std::size_t a = diagonal, b = diagonal + 1, c = diagonal + 2, d = (diagonal + 3) % 4;
        const double square = rise_[a] * rise_[c] - rise_[b] * rise_[d];
        const double linear = first_[c] * rise_[a] + first_[a] * rise_[c] - first_[d] * rise_[b] - first_[b] * rise_[d];
        const double constant = first_[a] * first_[c] - first_[b] * first_[d];
        const double t = -linear / (2 * square), greatest = linear * linear - 4 * square * constant;  // of F, times a positive number
        if (!(square < 0 && t > 0 && t < 1 && greatest >= 0)) return std::nullopt;
        const bool is_high = at(a, t) >= 0;
        if (is_high != (at(c, t) >= 0) || (!is_high && greatest == 0)) return std::nullopt;
        return JoinedCorners{corner_like(a, is_high), corner_like(c, is_high)};
    }

private:
    [[nodiscard]] double at(std::size_t edge, double t) const { return first_[edge] + t * rise_[edge]; }
    /// An end of an edge with the class of a point between its ends: the edge joins them.
    [[nodiscard]] int corner_like(std::size_t edge, bool is_high) const { return (first_[edge] >= 0) == is_high ? from_[edge] : to_[edge]; }

    std::array<int, 4> from_, to_;  ///< corners of the cell
    std::array<double, 4> first_, rise_;
};

}  // namespace isoatlas
