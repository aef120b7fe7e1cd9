// CoalescibleBlocks: the blocks of an octree of cells whose surface is one disk, as that of a cell with their corners alone.
//
//   position   of a vertex: its voxel + 1 along each axis, so that the padding begins at 0
//   block      of level k: 2^k x 2^k x 2^k cells, the first of them at 2^k times the block; a block of level 0 is a cell
//   children   of a block: the 8 of the level below in it. Together they have 27 vertices: its corners, the middles of its edges, the
//              centres of its faces and its own
//   regular    a middle whose two neighbours on the edge are not both of the other class; a centre of a face, of the block: the same of
//              its four, six neighbours
//   unambiguous the 8 corners of a block: no face is split, and the Highs as well as the Lows are connected along edges: one loop of hits
//
// A block is coalescible if its corners are unambiguous, its children are coalescible and the other 19 vertices are regular: words of bits
// decide for 64 blocks at a time, without looking at a sample. Theorem: docs/theory/10-level-of-detail.md#octree-fronts.
//
// In the literature: adaptive octrees with a test of topology (Ju, Losasso, Schaefer, Warren, Dual contouring of Hermite data, 2002, 4.2),
// which tests corners alone and only for dual surfaces.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/prefetch.h"
#include "isoatlas/context.h"
#include "levelset/high_bits.h"
#include "octree_front/bit_grid.h"

namespace isoatlas {

class CoalescibleBlocks {
public:
    /// Blocks are at most 32 cells wide.
    static constexpr int kMaxLevel = 5;

    /// high: all words, outlives this. max_level: 1 .. kMaxLevel. Cost: some 10 operations a word of 64 vertices where classes are mixed.
    /// Memory: 0.3 bits a voxel.
    CoalescibleBlocks(const HighBits& high, int max_level, const Context& context);

    [[nodiscard]] int max_level() const { return static_cast<int>(levels_.size()) - 1; }
    /// How many blocks cover all cells.
    [[nodiscard]] const Index3& blocks(int level) const { return levels_[static_cast<std::size_t>(level)].size; }
    /// Vertex: of a block of the level, its first corner.
    [[nodiscard]] bool is_high(int level, std::int64_t x, std::int64_t y, std::int64_t z) const {
        return (vertices(level, x / 64, y, z) >> x % 64 & 1) != 0;
    }
    /// Bit i: the vertex i behind this one along x is High; at least 63 of them.
    [[nodiscard]] std::uint64_t vertex_bits(int level, const Index3& vertex) const {
        const std::int64_t w = vertex[0] / 64, bit = vertex[0] % 64;
        const std::uint64_t here = vertices(level, w, vertex[1], vertex[2]) >> bit;
        return bit == 0 ? here : here | vertices(level, w + 1, vertex[1], vertex[2]) << (64 - bit);
    }
    /// Level 1 or more. Also true of a block whose vertices are of one class.
    [[nodiscard]] bool is_coalescible(int level, const Index3& block) const {
        return levels_[static_cast<std::size_t>(level)].coalescible[block];
    }
    /// Prefetches the classes of the samples of a row of blocks, y and z.
    void prefetch_samples(int level, std::int64_t y, std::int64_t z) const {
        const std::int64_t width = std::int64_t{1} << level, first = std::max<std::int64_t>(y * width - 1, 0);
        const std::int64_t last = std::min((y + 1) * width, high_.extent().size[1]) - 1;
        for (std::int64_t i = z * width; i <= (z + 1) * width; ++i)
            prefetch(high_.row(first, i - 1), high_.row(last, i - 1) + high_.words());
    }
    /// Bit c: corner c is High (field/cell.h).
    [[nodiscard]] int pattern(int level, const Index3& block) const;
    /// The patterns of the children of a block of level 1 or more, x first.
    [[nodiscard]] std::array<std::uint8_t, 8> child_patterns(int level, const Index3& block) const;

private:
    struct Level {
        Index3 size;          ///< how many blocks
        BitGrid coalescible;  ///< one bit a block; empty of level 0: one disk or several, a cell is a leaf
        BitGrid vertices;     ///< High corners of the blocks; empty of level 0, where the bits of the samples are
    };
    /// Null outside, where all are Low.
    [[nodiscard]] const std::uint64_t* vertex_row(int level, std::int64_t y, std::int64_t z) const {
        return level == 0 ? high_.row(y - 1, z - 1) : levels_[static_cast<std::size_t>(level)].vertices.row(y, z);
    }
    [[nodiscard]] std::int64_t vertex_words(int level) const {
        return level == 0 ? high_.words() : levels_[static_cast<std::size_t>(level)].vertices.words();
    }
    [[nodiscard]] std::uint64_t vertices(int level, std::int64_t w, std::int64_t y, std::int64_t z) const {
        const std::uint64_t* const row = vertex_row(level, y, z);
        return row != nullptr && w < vertex_words(level) ? row[w] : 0;
    }
    class Mixed;
    void test_row(int level, std::int64_t y, std::int64_t z, Mixed& mixed);
    /// Bit i: all children of block 64 w + i of the row are coalescible.
    [[nodiscard]] std::uint64_t test_children(int level, std::int64_t w, std::int64_t y, std::int64_t z) const;

    const HighBits& high_;
    std::vector<Level> levels_;
};

/// Bit i: the corners of cell i, bit i of the words of its 8 corners, are unambiguous.
[[nodiscard]] std::uint64_t unambiguous(const std::array<std::uint64_t, 8>& corner);
/// Bit i: the vertices of block i that are not corners, bit i of the words of all 27, x first, are regular.
[[nodiscard]] std::uint64_t regular(const std::array<std::uint64_t, 27>& vertex);

}  // namespace isoatlas
