// All of them, not a sample: engine equals oracle on every volume of some small families.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "oracle/compare.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

/// Every volume of a size whose samples take the values 0..levels-1.
void check_all(int rank, std::array<Index, 3> size, int levels) {
    Grid grid{rank, size, {}};
    grid.value.assign(static_cast<std::size_t>(grid.voxels()), 0);
    isoatlas::Context context;
    context.threads = 1;
    for (;;) {
        const Result expected = analyse(Elements(grid));
        ASSERT_TRUE(expected.consistent) << grid;
        ASSERT_EQ(compare(expected, isoatlas::analyse(to_volume(grid, isoatlas::ValueType::u8), {}, context)), "") << grid;
        std::size_t digit = 0;
        while (digit < grid.value.size() && grid.value[digit] == levels - 1) grid.value[digit++] = 0;
        if (digit == grid.value.size()) return;
        ++grid.value[digit];
    }
}

TEST(Exhaustive, TwoValued3x2x2) { check_all(3, {3, 2, 2}, 2); }
TEST(Exhaustive, ThreeValued2x2x2) { check_all(3, {2, 2, 2}, 3); }
TEST(Exhaustive, ThreeValued3x3x1) { check_all(3, {3, 3, 1}, 3); }
TEST(Exhaustive, ThreeValued3x3InTwoDimensions) { check_all(2, {3, 3, 1}, 3); }
TEST(Exhaustive, TwoValued4x4InTwoDimensions) { check_all(2, {4, 4, 1}, 2); }

TEST(Exhaustive, AllOrdersOfACell) {
    Grid grid{3, {2, 2, 2}, std::vector<double>(8)};
    std::iota(grid.value.begin(), grid.value.end(), 0.0);
    isoatlas::Context context;
    context.threads = 1;
    do {
        const Result expected = analyse(Elements(grid));
        ASSERT_TRUE(expected.consistent) << grid;
        ASSERT_EQ(compare(expected, isoatlas::analyse(to_volume(grid, isoatlas::ValueType::u8), {}, context)), "") << grid;
    } while (std::next_permutation(grid.value.begin(), grid.value.end()));
}

}  // namespace
}  // namespace oracle
