#include "octree_front/coalescible_blocks.h"

#include <algorithm>

#include "base/phase.h"
#include "field/cell.h"
#include "field/slab_work.h"
#include "octree_front/front_phases.h"

namespace isoatlas {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

/// Which of the 27 vertices.
constexpr std::size_t vertex_at(int x, int y, int z) { return static_cast<std::size_t>(x + 3 * y + 9 * z); }

Index3 halved(const Index3& blocks) { return {(blocks[0] + 1) / 2, (blocks[1] + 1) / 2, (blocks[2] + 1) / 2}; }

/// Bit i: block i has unambiguous corners and regular vertices. row: of vertices, y first: 128 of each, and the one behind them.
std::uint64_t test_corners(const std::array<std::array<std::uint64_t, 3>, 9>& row) {
    std::array<std::uint64_t, 27> vertex;
    for (int i = 0; i < 9; ++i) {
        const std::uint64_t near = even_bits(row[i][0], row[i][1]);
        vertex[vertex_at(0, i % 3, i / 3)] = near;
        vertex[vertex_at(1, i % 3, i / 3)] = even_bits(row[i][0] >> 1, row[i][1] >> 1);
        vertex[vertex_at(2, i % 3, i / 3)] = near >> 1 | row[i][2] << 63;
    }
    std::array<std::uint64_t, 8> corner;
    for (int c = 0; c < 8; ++c) corner[c] = vertex[vertex_at(2 * (c & 1), 2 * (c >> 1 & 1), 2 * (c >> 2))];
    return unambiguous(corner) & regular(vertex);
}

}  // namespace

std::uint64_t unambiguous(const std::array<std::uint64_t, 8>& corner) {
    std::uint64_t bad = 0;
    for (const std::array<int, 4>& face : kFaceCorners) {
        const std::uint64_t a = corner[face[0]], b = corner[face[1]], c = corner[face[2]], d = corner[face[3]];
        bad |= (a ^ b) & ~(a ^ c) & ~(b ^ d);
    }
    const auto is_alone = [&](int k) { return (corner[k] ^ corner[k ^ 1]) & (corner[k] ^ corner[k ^ 2]) & (corner[k] ^ corner[k ^ 4]); };
    for (int k = 0; k < 4; ++k) bad |= is_alone(k) & is_alone(7 - k);
    return ~bad;
}

std::uint64_t regular(const std::array<std::uint64_t, 27>& vertex) {
    constexpr std::array<int, 3> kStep{1, 3, 9};
    std::uint64_t bad = 0;
    for (int at = 0; at < 27; ++at) {
        const std::array<int, 3> place{at % 3, at / 3 % 3, at / 9};
        std::uint64_t differs = kAll;
        bool is_corner = true;
        for (int axis = 0; axis < 3; ++axis) {
            if (place[axis] != 1) continue;
            is_corner = false;
            differs &= (vertex[at] ^ vertex[at - kStep[axis]]) & (vertex[at] ^ vertex[at + kStep[axis]]);
        }
        if (!is_corner) bad |= differs;
    }
    return ~bad;
}

CoalescibleBlocks::CoalescibleBlocks(const HighBits& high, int max_level, const Context& context)
    : high_(high), levels_(static_cast<std::size_t>(max_level) + 1) {
    const Extent& extent = high.extent();
    Index3 blocks{extent.size[0] + 1, extent.size[1] + 1, extent.size[2] + 1};
    for (std::size_t level = 0; level < levels_.size(); ++level, blocks = halved(blocks)) {
        levels_[level].coalescible = BitGrid(blocks, true);
        if (level > 0) levels_[level].vertices = BitGrid({blocks[0] + 1, blocks[1] + 1, blocks[2] + 1}, false);
    }
    const auto for_rows = [&](int level, const auto& visit) {
        const Index3& size = this->blocks(level);
        for_each_slab(context, kFrontPhases["blocks"], {size[2], size[0] * size[1]}, [&](const Slab& slab) {
            for (std::int64_t z = slab.z_begin; z < slab.z_end; ++z) {
                for (std::int64_t y = 0; y < size[1]; ++y) visit(y, z);
            }
        });
    };
    for_rows(0, [&](std::int64_t y, std::int64_t z) { test_cells(y, z); });
    for (int level = 1; level <= max_level; ++level) {
        const Index3& size = levels_[static_cast<std::size_t>(level)].vertices.size();
        for_each_slab(context, kFrontPhases["blocks"], {size[2], size[0] * size[1]}, [&](const Slab& slab) {
            for (std::int64_t z = slab.z_begin; z < slab.z_end; ++z) keep_vertices(level, z);
        });
        for_rows(level, [&](std::int64_t y, std::int64_t z) { test_blocks(level, y, z); });
    }
}

std::uint64_t CoalescibleBlocks::vertices(int level, std::int64_t w, std::int64_t y, std::int64_t z) const {
    if (level == 0) return w < high_.words() ? high_.row(y - 1, z - 1)[w] : 0;
    const BitGrid& grid = levels_[static_cast<std::size_t>(level)].vertices;
    return grid.word(grid.row(y, z), w);
}

int CoalescibleBlocks::pattern(int level, const Index3& block) const {
    int pattern = 0;
    for (int row = 0; row < 4; ++row) {
        const std::int64_t y = block[1] + (row & 1), z = block[2] + (row >> 1), w = block[0] / 64, bit = block[0] % 64;
        std::uint64_t both = vertices(level, w, y, z) >> bit;
        if (bit == 63) both |= vertices(level, w + 1, y, z) << 1;
        pattern |= static_cast<int>(both & 3) << 2 * row;
    }
    return pattern;
}

void CoalescibleBlocks::test_cells(std::int64_t y, std::int64_t z) {
    BitGrid& cells = levels_[0].coalescible;
    std::uint64_t* const found = cells.row(y, z);
    const std::array<const std::uint64_t*, 4> row{high_.row(y - 1, z - 1), high_.row(y, z - 1), high_.row(y - 1, z), high_.row(y, z)};
    for (std::int64_t w = 0; w < cells.words(); ++w) {
        std::array<std::uint64_t, 8> corner;
        std::uint64_t any = 0, all = kAll;
        for (std::size_t i = 0; i < 4; ++i) {
            corner[2 * i] = row[i][w], corner[2 * i + 1] = bits_after(row[i], w);
            any |= corner[2 * i] | corner[2 * i + 1], all &= corner[2 * i] & corner[2 * i + 1];
        }
        if ((any & ~all) != 0) found[w] = unambiguous(corner);
    }
}

void CoalescibleBlocks::keep_vertices(int level, std::int64_t z) {
    BitGrid& grid = levels_[static_cast<std::size_t>(level)].vertices;
    for (std::int64_t y = 0; y < grid.size()[1]; ++y) {
        std::uint64_t* const row = grid.row(y, z);
        for (std::int64_t w = 0; w < grid.words(); ++w)
            row[w] = even_bits(vertices(level - 1, 2 * w, 2 * y, 2 * z), vertices(level - 1, 2 * w + 1, 2 * y, 2 * z));
    }
}

void CoalescibleBlocks::test_blocks(int level, std::int64_t y, std::int64_t z) {
    BitGrid& blocks = levels_[static_cast<std::size_t>(level)].coalescible;
    const BitGrid& children = levels_[static_cast<std::size_t>(level) - 1].coalescible;
    std::uint64_t* const found = blocks.row(y, z);
    for (std::int64_t w = 0; w < blocks.words(); ++w) {
        std::uint64_t good = kAll;
        for (int i = 0; i < 4; ++i) {
            const std::uint64_t* const cells = children.row(2 * y + (i & 1), 2 * z + (i >> 1));
            const std::uint64_t first = children.word(cells, 2 * w), second = children.word(cells, 2 * w + 1);
            if ((first & second) != kAll) good &= even_bits(first, second) & even_bits(first >> 1, second >> 1);
        }
        std::array<std::array<std::uint64_t, 3>, 9> row;
        std::uint64_t any = 0, all = kAll;
        for (int i = 0; i < 9; ++i) {
            for (int k = 0; k < 3; ++k) row[i][k] = vertices(level - 1, 2 * w + k, 2 * y + i % 3, 2 * z + i / 3);
            any |= row[i][0] | row[i][1] | (row[i][2] & 1), all &= row[i][0] & row[i][1] & (row[i][2] | ~std::uint64_t{1});
        }
        found[w] = any == 0 || all == kAll ? good : good & test_corners(row);
    }
}

}  // namespace isoatlas
