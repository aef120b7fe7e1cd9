// Plain cells: cells whose triangles follow from which of their corners are High: no face is split, and they have no points of their own.
// Nearly all are.
//
// The hits on each kind of edge have consecutive numbers along a row, so eight counters, the next hit of edges 0, 1, 2, 3 (along x), 4, 6
// (along y), 8, 10 (along z), say where the hits of a cell are written. Seen along x, the four rows around a row of cells:
//
//     z + 1   2 --- 6 --- 3      0, 1, 2, 3: the edges along x of the cell, one in each of its four rows
//             |           |      4, 6, 8, 10: its edges at position p, the near side
//             8           10     5, 7, 9, 11: the same at position p + 1, the far side: they belong to the next cell
//             |           |
//       z     0 --- 4 --- 1
//             y         y + 1
//
// The far edges are where the near ones are after the cell. So its hits are among 16 numbers, the counters before and after it:
//
//   number    0  1  2  3  4  5  6  7   |   8  9 10 11 12 13 14 15
//   edge      0  1  2  3  4  6  8 10   |   -  -  -  -  5  7  9 11
//
// In the literature: the unambiguous cases of Marching Cubes (Lorensen, Cline 1987).
#pragma once

#include <array>
#include <cstdint>

#include "levelset/active_cells.h"
#include "mesh/cell_triangles.h"
#include "mesh/layout.h"

namespace isoatlas {

inline constexpr std::array<int, 8> kCounterEdges{0, 1, 2, 3, 4, 6, 8, 10};

/// Tables by pattern.
struct PlainCells {
    std::array<std::uint8_t, 256> triangles{};               ///< 0: not a plain cell
    std::array<std::uint8_t, 256> moves{};                   ///< bit i: counter i is incremented
    std::array<std::array<std::uint8_t, 16>, 256> corner{};  ///< 3 per triangle, among the 16 numbers

    /// tunnels: may cells have any? flip: triangles are oriented the other way round.
    PlainCells(SurfaceStyle style, bool tunnels, bool flip);
};

/// The counters of a row of cells.
using HitCounters = std::array<std::int64_t, 8>;

/// The hits of a cell by edges; those of edges that are not hit mean nothing.
[[nodiscard]] inline std::array<std::int64_t, 12> points_of(const HitCounters& before, const HitCounters& after) {
    return {before[0], before[1], before[2], before[3], before[4], after[4], before[5], after[5], before[6], after[6], before[7], after[7]};
}

/// Counts the hits on the edges that begin in the first of the rows, and the triangles of the plain cells; marks their words. Calls
/// rest(p, pattern) for the other active cells, p ascending.
template <class Rest>
void count_plain(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, RowOffsets& place, Rest&& rest) {
    rows.candidates.for_each([&](std::int64_t w) {
        count_hits(w, (rows.row[0][w] ^ bits_after(rows.row[0], w)) & window.mask(w), rows.row[0][w] ^ rows.row[1][w],
                   rows.row[0][w] ^ rows.row[2][w], place);
    });
    for_active_cells(rows, window, [&](std::int64_t p, int pattern) {
        mark_word(place.cell_words, p / 64);
        const int own = cells.triangles[static_cast<std::size_t>(pattern)];
        place.triangle += own;
        if (own == 0) rest(p, pattern);
    });
}

/// Writes the triangles of the plain cells of a row from `triangle` on, all before `end`. Calls rest(p, pattern, counters before, counters
/// after, triangle) for the other active ones, which moves `triangle` on.
template <class Rest>
void write_plain(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, HitCounters next,
                 std::array<std::int64_t, 3>* triangle, const std::array<std::int64_t, 3>* /*end*/, Rest&& rest) {
    std::array<std::int64_t, 16> both;
    for_active_cells(rows, window, [&](std::int64_t p, int pattern) {
        const auto entry = static_cast<std::size_t>(pattern);
        HitCounters after;
        for (std::size_t i = 0; i < 8; ++i) after[i] = next[i] + (cells.moves[entry] >> i & 1);
        const int count = cells.triangles[entry];
        if (count == 0) {
            rest(p, pattern, next, after, triangle);
        } else {
            for (std::size_t i = 0; i < 8; ++i) both[i] = next[i], both[8 + i] = after[i];
            const std::uint8_t* corner = cells.corner[entry].data();
            for (int i = 0; i < count; ++i, corner += 3) *triangle++ = {both[corner[0]], both[corner[1]], both[corner[2]]};
        }
        next = after;
    });
}

}  // namespace isoatlas
