// Enumeration of the active cells, those that the surface passes through, 64 at a time.
//
// Cell row (y, z) lies between the rows (y, z), (y + 1, z), (y, z + 1), (y + 1, z + 1); y and z from -1 (padding). Its cell p has the
// voxels x = p - 1 and x = p. In 2D a row of squares lies between the rows y and y + 1.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "field/cell_loops.h"
#include "field/face.h"
#include "field/sample_grid.h"
#include "levelset/high_bits.h"

namespace isoatlas {

/// Which cells (and hits) count: all that touch the volume, or only those whose corners are all voxels.
struct CellWindow {
    std::int64_t begin, end;  ///< cells of a row: begin <= p < end
    [[nodiscard]] static CellWindow all(std::int64_t row_size) { return {0, row_size + 1}; }
    [[nodiscard]] static CellWindow real(std::int64_t row_size) { return {1, row_size}; }
    /// The cells of the window among 64 w .. 64 w + 63, as bits.
    [[nodiscard]] std::uint64_t mask(std::int64_t w) const {
        const std::int64_t first = begin - 64 * w, last = end - 64 * w;
        if (first >= 64 || last <= 0) return 0;
        const std::uint64_t from = first <= 0 ? ~std::uint64_t{0} : ~std::uint64_t{0} << first;
        return last >= 64 ? from : from & ~(~std::uint64_t{0} << last);
    }
};

/// The rows around a row of cells, in the order of the corners of a cell: y first. 4 rows in 3D, 2 in 2D.
template <int kRows>
struct CellRow {
    std::array<const std::uint64_t*, kRows> row;
    WordSet candidates;

    /// Bit p: the corners of cell p are neither all High nor all Low.
    [[nodiscard]] std::uint64_t active(std::int64_t w) const {
        std::uint64_t any = 0, all = ~std::uint64_t{0};
        for (const std::uint64_t* bits : row) {
            const std::uint64_t here = bits[w], after = bits_after(bits, w);
            any |= here | after;
            all &= here & after;
        }
        return any & ~all;
    }
};

inline CellRow<4> cell_row(const HighBits& high, std::int64_t y, std::int64_t z) {
    return {{high.row(y, z), high.row(y + 1, z), high.row(y, z + 1), high.row(y + 1, z + 1)}, high.candidates(y, z)};
}
inline CellRow<2> square_row(const HighBits& high, std::int64_t y) { return {{high.row(y, 0), high.row(y + 1, 0)}, high.candidates(y, 0)}; }

/// Calls visit(p, pattern) for every active cell of the window, p ascending. pattern: bit 2 r + i is corner p + i of row r.
template <int kRows, class Visit>
void for_active_cells(const CellRow<kRows>& rows, const CellWindow& window, Visit&& visit) {
    rows.candidates.for_each([&](std::int64_t w) {
        const std::uint64_t active = rows.active(w) & window.mask(w);
        if (active == 0) return;
        for (int half = 0; half < 2; ++half) {  // 32 cells at a time: then both corners lie in one word
            std::array<std::uint64_t, kRows> bits;
            for (int r = 0; r < kRows; ++r) bits[r] = half == 0 ? rows.row[r][w] : rows.row[r][w] >> 32 | rows.row[r][w + 1] << 32;
            for (auto rest = static_cast<std::uint32_t>(active >> 32 * half); rest != 0; rest &= rest - 1) {
                const int i = std::countr_zero(rest);
                unsigned pattern = 0;
                for (int r = 0; r < kRows; ++r) pattern |= static_cast<unsigned>(bits[r] >> i & 3) << 2 * r;
                visit(64 * w + 32 * half + i, static_cast<int>(pattern));
            }
        }
    });
}

/// Number of active cells of a row.
template <int kRows>
std::int64_t count_active_cells(const CellRow<kRows>& rows, const CellWindow& window) {
    std::int64_t count = 0;
    rows.candidates.for_each([&](std::int64_t w) { count += std::popcount(rows.active(w) & window.mask(w)); });
    return count;
}

/// Decides 4-hit faces at one isovalue.
template <class T>
struct FaceJoiner {
    SampleGrid<T> grid;
    double tau;

    /// Are the Highs of the face of an orientation with corner a at a voxel joined? The face is 4-hit, the Highs on the given diagonal.
    [[nodiscard]] bool operator()(const Index3& voxel, int orientation, Diagonal highs) const {
        const FaceAxes axes = kFaceAxes[orientation];
        const int b = 1 << axes.axis1, d = 1 << axes.axis2;
        return highs_are_joined(grid.corner(voxel, 0), grid.corner(voxel, b), grid.corner(voxel, b | d), grid.corner(voxel, d), highs, tau);
    }

    /// Joined mask of the split faces of a cell with corner 0 at `cell` (may be a padding position; split faces have real corners).
    [[nodiscard]] int joined_mask(const Index3& cell, int pattern, int split_faces) const {
        int joined = 0;
        for (int rest = split_faces; rest != 0; rest &= rest - 1) {
            const int f = std::countr_zero(static_cast<unsigned>(rest));
            const int a = kFaceCorners[f][0];
            const Diagonal highs = pattern >> a & 1 ? Diagonal::ac : Diagonal::bd;
            joined |= int{(*this)({cell[0] + (a & 1), cell[1] + (a >> 1 & 1), cell[2] + (a >> 2)}, f / 2, highs)} << f;
        }
        return joined;
    }
};

}  // namespace isoatlas
