// Layout of a surface: where every point and triangle goes, before any is made. The surface is written in place, in parallel, and its order
// does not depend on threads or slabs. extract.cpp runs four passes:
//   PASS 1  count the hits of every row along x, y, z, and the triangles and articulation points of its cells
//   PASS 2  exclusive scan over the rows: counts become offsets; the arrays of the surface get their sizes
//   PASS 3  write the points and normals of the hits (mesh/hits.h)
//   PASS 4  write the triangles, and the articulation points, which are means of hits (mesh/cells.h; 2D: segments, mesh/squares.h)
//
// The notation of this folder:
//   hit      edge crossing: the point of the surface on an edge of the grid between a High and a Low; edges to the padding included
//   row      all samples, edges and cells of one (y, z); y and z from -1 (padding). Position p of a row is voxel x = p - 1
//   cell     cell p of row (y, z): the positions p and p + 1 of the rows (y, z), (y + 1, z), (y, z + 1), (y + 1, z + 1)
//   pattern  the classes of the 8 corners of a cell, High = 1 (field/cell.h); a plain cell needs nothing else (mesh/plain_cells.h)
//   word     64 positions of a row, as bits
//   group    the rows of one slice within a brick along y: 8 rows (RowGroups); passes 1 and 4 run group by group
//   bundle   8 x 32 rows along y and z (mesh/bundle_samples.h), the unit of PASS 3
//   brick    16 x 8 x 8 samples (field/brick_grid.h)
//
// Points and triangles are ordered by row (y, z). A row owns the hits on its own edges along x, on the edges to row (y + 1, z), on those to
// (y, z + 1), in this order, each by ascending position, then the articulation points of its cells.
//
// In the literature: offsets by prefix sums over rows: Flying Edges (Schroeder, Maynard, Geveci 2015).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/big_vector.h"
#include "isoatlas/surface.h"
#include "levelset/active_cells.h"

namespace isoatlas {

/// The domain of a mesh: bits, and the cells and rows that belong to the surface.
struct MeshDomain {
    const HighBits& high;
    CellWindow cells;             ///< of every row
    std::int64_t y_begin, y_end;  ///< cell rows: y_begin <= y < y_end
    std::int64_t z_begin, z_end;

    MeshDomain(const HighBits& bits, Boundary boundary);
    [[nodiscard]] bool is_2d() const { return high.extent().rank == 2; }
    [[nodiscard]] bool is_empty() const { return cells.begin >= cells.end || y_begin >= y_end || (!is_2d() && z_begin >= z_end); }
    /// Rows of points: one more than cell rows on each axis (the far side of the last cells).
    [[nodiscard]] std::int64_t rows_y() const { return y_end - y_begin + 1; }
    [[nodiscard]] std::int64_t rows_z() const { return z_end - z_begin + 1; }
    [[nodiscard]] std::int64_t row_number(std::int64_t y, std::int64_t z) const { return y - y_begin + rows_y() * (z - z_begin); }
    [[nodiscard]] bool has_next_y(std::int64_t y) const { return y < y_end; }
    [[nodiscard]] bool has_next_z(std::int64_t z) const { return z < z_end; }
};

/// Counts after PASS 1, offsets after PASS 2. RowOffsets{} is zeros; a new array of them is uninitialised.
struct RowOffsets {
    std::int64_t point;     ///< first point of the row
    std::int64_t triangle;  ///< first triangle (2D: segment)
    std::uint32_t x_hits, y_hits, z_hits, articulation_points;
    std::uint64_t hit_words, cell_words;  ///< which words have hits, which have active cells, as bits; if there are no more than 64

    [[nodiscard]] std::int64_t first_y() const { return point + x_hits; }
    [[nodiscard]] std::int64_t first_z() const { return first_y() + y_hits; }
    [[nodiscard]] std::int64_t first_articulation_point() const { return first_z() + z_hits; }
};

/// The words of a counted row that need be read.
[[nodiscard]] inline WordSet words_of(const HighBits& high, const std::uint64_t& counted, const WordSet& candidates) {
    return high.words() <= 64 ? WordSet{&counted, 1} : candidates;
}
/// Marks a counted word.
inline void mark_word(std::uint64_t& words, std::int64_t w) { words |= std::uint64_t{1} << w % 64; }

/// The edges of a row that are hit, 64 positions at a time.
struct RowHits {
    const std::uint64_t *row, *next_y, *next_z;
    WordSet candidates;
    CellWindow window;
    bool y_edges, z_edges;

    RowHits(const MeshDomain& domain, std::int64_t y, std::int64_t z)
        : row(domain.high.row(y, z)),
          next_y(domain.high.row(y + 1, z)),
          next_z(domain.high.row(y, z + 1)),
          candidates(domain.high.candidates(y, z)),
          window(domain.cells),
          y_edges(domain.has_next_y(y)),
          z_edges(domain.has_next_z(z)) {}
    /// Of a row that has been counted.
    RowHits(const MeshDomain& domain, std::int64_t y, std::int64_t z, const RowOffsets& place) : RowHits(domain, y, z) {
        candidates = words_of(domain.high, place.hit_words, candidates);
    }
    /// Bit p: the edge between the positions p and p + 1 is hit.
    [[nodiscard]] std::uint64_t x(std::int64_t w) const { return (row[w] ^ bits_after(row, w)) & window.mask(w); }
    [[nodiscard]] std::uint64_t y(std::int64_t w) const { return y_edges ? row[w] ^ next_y[w] : 0; }
    [[nodiscard]] std::uint64_t z(std::int64_t w) const { return z_edges ? row[w] ^ next_z[w] : 0; }
};

/// Groups of adjacent rows, those of a brick, which of them have hits or active cells, and what was found in their cells.
class RowGroups {
public:
    static constexpr std::int64_t kSide = kBrickSize[1];

    explicit RowGroups(const MeshDomain& domain)
        : first_(group_of(domain.y_begin)),
          count_(group_of(domain.y_end) - first_ + 1),
          z_begin_(domain.z_begin),
          used_(static_cast<std::size_t>(count_ * domain.rows_z())),
          found_(used_.size()) {}
    /// Of y from -1 on: row -1 is a group of its own.
    [[nodiscard]] static std::int64_t group_of(std::int64_t y) { return (y + kSide) / kSide; }
    [[nodiscard]] std::int64_t begin() const { return first_; }
    [[nodiscard]] std::int64_t end() const { return first_ + count_; }
    /// Rows [begin, end) of a group.
    [[nodiscard]] static std::array<std::int64_t, 2> rows(const MeshDomain& domain, std::int64_t group) {
        return {std::max(domain.y_begin, kSide * (group - 1)), std::min(domain.y_end + 1, kSide * group)};
    }
    /// Groups of different slices may be used by several threads.
    void use(std::int64_t group, std::int64_t z) { used_[place(group, z)] = 1; }
    [[nodiscard]] bool is_used(std::int64_t group, std::int64_t z) const { return used_[place(group, z)] != 0; }
    /// The numbers of the cells that are not plain (CellWriter::count_row), row by row.
    [[nodiscard]] std::vector<std::uint8_t>& found(std::int64_t group, std::int64_t z) { return found_[place(group, z)]; }

private:
    [[nodiscard]] std::size_t place(std::int64_t group, std::int64_t z) const {
        return static_cast<std::size_t>(group - first_ + count_ * (z - z_begin_));
    }
    std::int64_t first_, count_, z_begin_;
    std::vector<std::uint8_t> used_;
    std::vector<std::vector<std::uint8_t>> found_;
};

/// Offsets of all rows; the last entry holds the totals.
using Layout = BigVector<RowOffsets>;

/// How many slices ahead rows are prefetched: one more than is read.
inline constexpr std::int64_t kSlicesAhead = 3;
/// Prefetches the bits and the offsets of rows [y, end) of a slice, inside the grid: slices lie too far apart for a processor to predict.
void prefetch_rows(const MeshDomain& domain, const Layout& layout, std::int64_t y, std::int64_t end, std::int64_t z);

/// Adds the hits of word w of a row to its counts, along each axis, and marks the word.
[[gnu::always_inline]] inline void count_hits(std::int64_t w, std::uint64_t x, std::uint64_t y, std::uint64_t z, RowOffsets& place) {
    if ((x | y | z) == 0) return;
    place.x_hits += static_cast<std::uint32_t>(std::popcount(x));
    place.y_hits += static_cast<std::uint32_t>(std::popcount(y));
    place.z_hits += static_cast<std::uint32_t>(std::popcount(z));
    mark_word(place.hit_words, w);
}
/// PASS 1: the same for a whole row; triangles and articulation points are added by the caller.
void count_hits(const MeshDomain& domain, std::int64_t y, std::int64_t z, RowOffsets& place);
/// PASS 2. RowOffsets::triangle holds counts before, first numbers after.
void exclusive_scan_counts(Layout& layout);

}  // namespace isoatlas
