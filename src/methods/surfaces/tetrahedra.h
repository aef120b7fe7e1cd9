// Methods that cut a cell into tetrahedra and take the level set of the linear interpolant in each (section 3.5). No face is ambiguous
// then; but the cut decides which samples are joined across it, and a mirrored volume may have other objects.
//
// Five: a regular one in the middle and four at corners; the cells alternate, or their faces would not fit. Six: those around the diagonal
// from corner 0 to corner 7, along the paths 0 -> 7 of the three axes in any order. In the literature: Doi, Koide, An efficient method of
// triangulating equi-valued surfaces by using tetrahedral cells, 1991; Kuhn, 1960.
#pragma once

#include "methods/surfaces/edge_points.h"

namespace isoatlas {

using Tetrahedron = std::array<int, 4>;  ///< corners of a cell

inline constexpr std::array<Tetrahedron, 5> kFiveEven{{{1, 2, 4, 7}, {0, 1, 2, 4}, {3, 1, 2, 7}, {5, 1, 4, 7}, {6, 2, 4, 7}}};
inline constexpr std::array<Tetrahedron, 5> kFiveOdd{{{0, 3, 5, 6}, {1, 0, 3, 5}, {2, 0, 3, 6}, {4, 0, 5, 6}, {7, 3, 5, 6}}};
inline constexpr std::array<Tetrahedron, 6> kSix{{{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};

/// Of a cell, by the parity of its numbers where there are five.
[[nodiscard]] inline std::span<const Tetrahedron> tetrahedra_of(const Index3& cell, bool five) {
    if (!five) return kSix;
    return (cell[0] + cell[1] + cell[2]) % 2 == 0 ? std::span<const Tetrahedron>(kFiveEven) : kFiveOdd;
}

/// Six times the volume of the tetrahedron of four samples, positive where the others turn counter-clockwise seen from the first.
[[nodiscard]] inline std::int64_t orientation(const std::array<Index3, 4>& at) {
    const Index3 u = at[1] - at[0], v = at[2] - at[0], w = at[3] - at[0];
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/// Adds the triangles of a tetrahedron: none, one around its only High or Low, or two between two Highs and two Lows.
template <class T>
void add_tetrahedron(const Index3& cell, const Tetrahedron& corners, EdgePoints<T>& points) {
    std::array<Index3, 4> at;  // Highs first
    int highs = 0, lows = 0;
    for (const int corner : corners) {
        const Index3 sample = corner_of(cell, corner);
        if (points.is_high(sample))
            at[static_cast<std::size_t>(highs++)] = sample;
        else
            at[static_cast<std::size_t>(3 - lows++)] = sample;
    }
    if (highs == 0 || lows == 0) return;
    const auto edge = [&](std::size_t high, std::size_t low) { return points.point(at[high], at[low]); };
    std::array<std::int64_t, 4> ring;  // counter-clockwise seen from the Lows, if the four samples are oriented positively
    if (highs == 1)
        ring = {edge(0, 1), edge(0, 2), edge(0, 3), -1};
    else if (highs == 3)
        ring = {edge(0, 3), edge(1, 3), edge(2, 3), -1};
    else
        ring = {edge(0, 2), edge(0, 3), edge(1, 3), edge(1, 2)};
    const bool is_turned = orientation(at) < 0;
    const auto add = [&](std::size_t p, std::size_t q, std::size_t r) {
        points.add_triangle(ring[p], ring[is_turned ? r : q], ring[is_turned ? q : r]);
    };
    add(0, 1, 2);
    if (ring[3] >= 0) add(0, 2, 3);
}

/// Adds the triangles of a cell.
template <class T>
void add_tetrahedra(const Index3& cell, bool five, EdgePoints<T>& points) {
    for (const Tetrahedron& corners : tetrahedra_of(cell, five)) add_tetrahedron(cell, corners, points);
}

}  // namespace isoatlas
