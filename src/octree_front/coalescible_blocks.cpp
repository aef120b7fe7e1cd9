#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are returned by functions that are always inlined

#include "octree_front/coalescible_blocks.h"

#include <algorithm>
#include <cstring>

#include "base/phase.h"
#include "base/target_clones.h"
#include "field/cell.h"
#include "field/slab_work.h"
#include "octree_front/front_phases.h"

namespace isoatlas {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

Index3 halved(const Index3& blocks) { return {(blocks[0] + 1) / 2, (blocks[1] + 1) / 2, (blocks[2] + 1) / 2}; }

/// Words of 64 bits, and several of them side by side: what is computed for one is for all.
constexpr int kAtOnce = 8;
typedef std::uint64_t Words __attribute__((vector_size(8 * kAtOnce)));  // NOLINT(modernize-use-using): an alias would lose the attribute

/// Bit i: the corners of cell i are ambiguous.
template <class Word>
[[gnu::always_inline]] inline Word ambiguous_corners(const std::array<Word, 8>& corner) {
    Word bad{};
#pragma GCC unroll 6
    for (std::size_t f = 0; f < 6; ++f) {
        const std::array<int, 4>& face = kFaceCorners[f];
        const Word &a = corner[face[0]], &b = corner[face[1]], &c = corner[face[2]], &d = corner[face[3]];
        bad |= (a ^ b) & ~((a ^ c) | (b ^ d));
    }
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k) {
        const Word &one = corner[k], &other = corner[7 - k];
        bad |= (one ^ corner[k ^ 1]) & (one ^ corner[k ^ 2]) & (one ^ corner[k ^ 4]) &  // both are alone
               (other ^ corner[(7 - k) ^ 1]) & (other ^ corner[(7 - k) ^ 2]) & (other ^ corner[(7 - k) ^ 4]);
    }
    return bad;
}

/// Bit i: a vertex of block i that is no corner is not regular.
template <class Word>
[[gnu::always_inline]] inline Word irregular_vertices(const std::array<Word, 27>& vertex) {
    Word bad{};
#pragma GCC unroll 27
    for (int at = 0; at < 27; ++at) {
        if (at % 3 != 1 && at / 3 % 3 != 1 && at / 9 != 1) continue;  // a corner
        Word differs = ~Word{};
        if (at % 3 == 1) differs &= (vertex[at] ^ vertex[at - 1]) & (vertex[at] ^ vertex[at + 1]);
        if (at / 3 % 3 == 1) differs &= (vertex[at] ^ vertex[at - 3]) & (vertex[at] ^ vertex[at + 3]);
        if (at / 9 == 1) differs &= (vertex[at] ^ vertex[at - 9]) & (vertex[at] ^ vertex[at + 9]);
        bad |= differs;
    }
    return bad;
}

/// Rows of vertices, y first: 128 of each, and the one behind them.
template <class Word>
using VertexRows = std::array<std::array<Word, 3>, 9>;

/// Bit i: block i has ambiguous corners, or a vertex that is not regular.
template <class Word>
[[gnu::always_inline]] inline Word bad_vertices(const VertexRows<Word>& row) {
    std::array<Word, 27> vertex;
    for (int i = 0; i < 9; ++i) {
        const Word near = even_bits(row[i][0], row[i][1]);
        vertex[3 * i] = near;
        vertex[3 * i + 1] = even_bits(row[i][0] >> 1, row[i][1] >> 1);
        vertex[3 * i + 2] = near >> 1 | row[i][2] << 63;
    }
    std::array<Word, 8> corner;
    for (int c = 0; c < 8; ++c) corner[c] = vertex[2 * (c & 1) + 6 * (c >> 1 & 1) + 18 * (c >> 2)];
    return ambiguous_corners(corner) | irregular_vertices(vertex);
}

/// Bit i: one of the 8 cells of block i has ambiguous corners.
template <class Word>
[[gnu::always_inline]] inline Word bad_cells(const VertexRows<Word>& row) {
    Word bad{};
    for (int i = 0; i < 4; ++i) {
        const int first = (i & 1) + 3 * (i >> 1);
        for (int half = 0; half < 2; ++half) {
            std::array<Word, 8> corner;
            for (int k = 0; k < 4; ++k) {
                const std::array<Word, 3>& of = row[first + (k & 1) + 3 * (k >> 1)];
                corner[2 * k] = of[half], corner[2 * k + 1] = of[half] >> 1 | of[half + 1] << 63;
            }
            const Word cells = ambiguous_corners(corner);
            bad |= even_bits(cells | cells >> 1) << 32 * half;
        }
    }
    return bad;
}

/// The words that are tested at a time, by row, by word of the row.
using WordBatch = std::array<std::array<std::array<std::uint64_t, kAtOnce>, 3>, 9>;

/// with_cells: the blocks are of level 1. Bit i of a word: block i of its lane passes.
ISOATLAS_TARGET_CLONES void test_words(const WordBatch& words, bool with_cells, std::array<std::uint64_t, kAtOnce>& good) {
    VertexRows<Words> row;
    static_assert(sizeof row == sizeof words);
    std::memcpy(&row, &words, sizeof row);
    Words bad = bad_vertices(row);
    if (with_cells) bad |= bad_cells(row);
    bad = ~bad;
    std::memcpy(&good, &bad, sizeof good);
}

}  // namespace

/// Words of blocks where classes are mixed, until there are enough to test them.
class CoalescibleBlocks::Mixed {
public:
    explicit Mixed(int level) : with_cells_(level == 1) {}
    Mixed(const Mixed&) = delete;
    Mixed& operator=(const Mixed&) = delete;
    ~Mixed() { test(); }

    /// found: loses the bits of blocks that fail.
    void add(const VertexRows<std::uint64_t>& row, std::uint64_t& found) {
        for (std::size_t i = 0; i < 9; ++i) {
            for (std::size_t k = 0; k < 3; ++k) words_[i][k][count_] = row[i][k];
        }
        found_[count_] = &found;
        if (++count_ == kAtOnce) test();
    }

private:
    void test() {
        std::array<std::uint64_t, kAtOnce> good;
        if (count_ > 0) test_words(words_, with_cells_, good);
        for (std::size_t lane = 0; lane < count_; ++lane) *found_[lane] &= good[lane];
        count_ = 0;
    }
    WordBatch words_{};
    std::array<std::uint64_t*, kAtOnce> found_{};
    std::size_t count_ = 0;
    bool with_cells_;
};

std::uint64_t unambiguous(const std::array<std::uint64_t, 8>& corner) { return ~ambiguous_corners(corner); }
std::uint64_t regular(const std::array<std::uint64_t, 27>& vertex) { return ~irregular_vertices(vertex); }

CoalescibleBlocks::CoalescibleBlocks(const HighBits& high, int max_level, const Context& context)
    : high_(high), levels_(static_cast<std::size_t>(max_level) + 1) {
    const Extent& extent = high.extent();
    Index3 size{extent.size[0] + 1, extent.size[1] + 1, extent.size[2] + 1};
    for (int level = 0; level <= max_level; ++level, size = halved(size)) {
        Level& here = levels_[static_cast<std::size_t>(level)];
        here.size = size;
        if (level == 0) continue;
        here.coalescible = BitGrid(size, true);
        here.vertices = BitGrid({size[0] + 1, size[1] + 1, size[2] + 1}, false);
    }
    for (int level = 1; level <= max_level; ++level) {
        const Index3& vertices = levels_[static_cast<std::size_t>(level)].vertices.size();
        for_each_slab(context, kFrontPhases["blocks"], {vertices[2], 8 * vertices[0] * vertices[1]}, [&](const Slab& slab) {
            Mixed mixed(level);
            for (std::int64_t z = slab.z_begin; z < slab.z_end; ++z) {
                for (std::int64_t y = 0; y < vertices[1]; ++y) test_row(level, y, z, mixed);
            }
        });
    }
}

int CoalescibleBlocks::pattern(int level, const Index3& block) const {
    int pattern = 0;
    for (int row = 0; row < 4; ++row)
        pattern |= static_cast<int>(vertex_bits(level, {block[0], block[1] + (row & 1), block[2] + (row >> 1)}) & 3) << 2 * row;
    return pattern;
}

std::array<std::uint8_t, 8> CoalescibleBlocks::child_patterns(int level, const Index3& block) const {
    std::array<unsigned, 9> row;
    for (int i = 0; i < 9; ++i)
        row[i] = static_cast<unsigned>(vertex_bits(level - 1, {2 * block[0], 2 * block[1] + i % 3, 2 * block[2] + i / 3}) & 7);
    std::array<std::uint8_t, 8> patterns;
    for (int child = 0; child < 8; ++child) {
        const int x = child & 1, first = (child >> 1 & 1) + 3 * (child >> 2);
        patterns[child] = static_cast<std::uint8_t>((row[first] >> x & 3) | (row[first + 1] >> x & 3) << 2 |
                                                    (row[first + 3] >> x & 3) << 4 | (row[first + 4] >> x & 3) << 6);
    }
    return patterns;
}

std::uint64_t CoalescibleBlocks::test_children(int level, std::int64_t w, std::int64_t y, std::int64_t z) const {
    std::uint64_t good = kAll;
    const BitGrid& children = levels_[static_cast<std::size_t>(level) - 1].coalescible;
    for (int i = 0; i < 4; ++i) {
        const std::uint64_t* const row = children.row(2 * y + (i & 1), 2 * z + (i >> 1));
        const std::uint64_t first = children.word(row, 2 * w), second = children.word(row, 2 * w + 1);
        if ((first & second) != kAll) good &= even_bits(first, second) & even_bits(first >> 1, second >> 1);
    }
    return good;
}

void CoalescibleBlocks::test_row(int level, std::int64_t y, std::int64_t z, Mixed& mixed) {
    Level& here = levels_[static_cast<std::size_t>(level)];
    const bool has_blocks = y < here.size[1] && z < here.size[2];
    std::uint64_t* const found = has_blocks ? here.coalescible.row(y, z) : nullptr;
    std::uint64_t* const corners = here.vertices.row(y, z);
    std::array<const std::uint64_t*, 9> from;
    for (int i = 0; i < 9; ++i) from[i] = vertex_row(level - 1, 2 * y + i % 3, 2 * z + i / 3);
    const std::int64_t words = vertex_words(level - 1);
    const auto word = [words](const std::uint64_t* row, std::int64_t w) { return row != nullptr && w < words ? row[w] : 0; };
    for (std::int64_t w = 0; w < here.vertices.words(); ++w) {
        if (!has_blocks || w >= here.coalescible.words()) {
            corners[w] = even_bits(word(from[0], 2 * w), word(from[0], 2 * w + 1));
            continue;
        }
        VertexRows<std::uint64_t> row;
        std::uint64_t any = 0, all = kAll;
        for (int i = 0; i < 9; ++i) {
            for (int k = 0; k < 3; ++k) row[i][k] = word(from[i], 2 * w + k);
            any |= row[i][0] | row[i][1] | (row[i][2] & 1), all &= row[i][0] & row[i][1] & (row[i][2] | ~std::uint64_t{1});
        }
        const bool is_uniform = any == 0 || all == kAll;
        corners[w] = is_uniform ? any : even_bits(row[0][0], row[0][1]);
        found[w] = level > 1 ? test_children(level, w, y, z) : kAll;
        if (!is_uniform) mixed.add(row, found[w]);
    }
}

}  // namespace isoatlas
