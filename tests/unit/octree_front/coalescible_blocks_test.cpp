// What bits say of cells and blocks, one case at a time.
#include "octree_front/coalescible_blocks.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "field/cell_loops.h"

namespace isoatlas {
namespace {

TEST(CoalescibleBlocks, UnambiguousCellsHaveOneLoop) {
    for (int pattern = 0; pattern < 256; ++pattern) {
        std::array<std::uint64_t, 8> corner{};
        for (int c = 0; c < 8; ++c) corner[c] = (pattern >> c & 1) != 0 ? ~std::uint64_t{0} : 0;
        const bool is_split = cell_cases().split_faces[static_cast<std::size_t>(pattern)] != 0;
        const int loops = is_split ? 0 : cell_loops(pattern, 0).count;
        const std::uint64_t found = unambiguous(corner);
        EXPECT_EQ(found, !is_split && loops <= 1 ? ~std::uint64_t{0} : 0) << pattern;
    }
}

TEST(CoalescibleBlocks, EvenBitsAreEveryOther) {
    std::uint64_t word = 0x9e3779b97f4a7c15, other = 0xc2b2ae3d27d4eb4f;
    const std::uint64_t found = even_bits(word, other);
    for (int i = 0; i < 32; ++i) {
        EXPECT_EQ(found >> i & 1, word >> 2 * i & 1);
        EXPECT_EQ(found >> (32 + i) & 1, other >> 2 * i & 1);
    }
}

/// The definition, vertex by vertex.
bool is_regular(std::uint32_t vertices) {
    const auto high = [&](int x, int y, int z) { return (vertices >> (x + 3 * y + 9 * z) & 1) != 0; };
    for (int at = 0; at < 27; ++at) {
        const std::array<int, 3> p{at % 3, at / 3 % 3, at / 9};
        int neighbours = 0, differ = 0;
        for (int axis = 0; axis < 3; ++axis) {
            for (const int step : {-1, 1}) {
                if (p[axis] != 1) continue;
                std::array<int, 3> q = p;
                q[axis] += step;
                ++neighbours;
                differ += high(q[0], q[1], q[2]) != high(p[0], p[1], p[2]);
            }
        }
        if (neighbours > 0 && differ == neighbours) return false;
    }
    return true;
}

RC_GTEST_PROP(CoalescibleBlocks, RegularVerticesAreNotAlone, ()) {
    std::array<std::uint32_t, 64> blocks;
    std::array<std::uint64_t, 27> vertex{};
    for (std::size_t i = 0; i < 64; ++i) {
        blocks[i] = *rc::gen::arbitrary<std::uint32_t>();
        for (std::size_t v = 0; v < 27; ++v) vertex[v] |= std::uint64_t{blocks[i] >> v & 1} << i;
    }
    const std::uint64_t found = regular(vertex);
    for (std::size_t i = 0; i < 64; ++i) RC_ASSERT((found >> i & 1) == (is_regular(blocks[i]) ? 1U : 0U));
}

}  // namespace
}  // namespace isoatlas
