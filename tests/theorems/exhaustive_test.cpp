// All of them, not a sample: engine equals oracle on every volume of some small families, in one of the ways to turn it.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "oracle/bodies.h"
#include "oracle/compare.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

void check_interpolants(const Grid& grid) {
    isoatlas::Context context;
    context.threads = 1;
    const isoatlas::Volume volume = to_volume(grid, isoatlas::ValueType::u8);
    for (const isoatlas::Interpolant interpolant : {isoatlas::Interpolant::faces, isoatlas::Interpolant::trilinear}) {
        if (interpolant == isoatlas::Interpolant::trilinear && grid.size[2] == 1) continue;  // no cell
        const Result expected = analyse(elements_of(grid, interpolant));
        ASSERT_TRUE(expected.consistent) << grid;
        ASSERT_EQ(compare(expected, isoatlas::analyse(volume, {.interpolant = interpolant}, context)), "")
            << isoatlas::name_of(interpolant) << grid;
    }
}

/// Every volume of a size whose samples take the values 0..levels-1.
void check_all(int rank, std::array<Index, 3> size, int levels) {
    Grid grid{rank, size, {}};
    grid.value.assign(static_cast<std::size_t>(grid.voxels()), 0);
    std::mt19937_64 random(std::random_device{}());
    for (;;) {
        ASSERT_NO_FATAL_FAILURE(for_one_image(grid, random, check_interpolants));
        std::size_t digit = 0;
        while (digit < grid.value.size() && grid.value[digit] == levels - 1) grid.value[digit++] = 0;
        if (digit == grid.value.size()) return;
        ++grid.value[digit];
    }
}

TEST(EngineEqualsTheOracle, OnEvery3x2x2VolumeOfTwoValues) { check_all(3, {3, 2, 2}, 2); }
TEST(EngineEqualsTheOracle, OnEvery2x2x2VolumeOfFourValues) { check_all(3, {2, 2, 2}, 4); }
TEST(EngineEqualsTheOracle, OnEvery3x3x1VolumeOfThreeValues) { check_all(3, {3, 3, 1}, 3); }
TEST(EngineEqualsTheOracle, OnEvery3x3ImageOfThreeValues) { check_all(2, {3, 3, 1}, 3); }
TEST(EngineEqualsTheOracle, OnEvery4x4ImageOfTwoValues) { check_all(2, {4, 4, 1}, 2); }

TEST(EngineEqualsTheOracle, OnAllOrdersOfACell) {
    Grid grid{3, {2, 2, 2}, std::vector<double>(8)};
    std::iota(grid.value.begin(), grid.value.end(), 0.0);
    std::mt19937_64 random(std::random_device{}());
    do {
        ASSERT_NO_FATAL_FAILURE(for_one_image(grid, random, check_interpolants));
    } while (std::next_permutation(grid.value.begin(), grid.value.end()));
}

}  // namespace
}  // namespace oracle
