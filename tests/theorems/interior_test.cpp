// The trilinear interpolant: body points and tunnels (docs/theory/6-interior.md).
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <tuple>

#include "isoatlas/isoatlas.h"
#include "oracle/compare.h"
#include "oracle/finer.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::Interpolant;
using isoatlas::Volume;

isoatlas::Context one_thread() {
    isoatlas::Context context;
    context.threads = 1;
    return context;
}

/// The first guarantee that does not hold; empty: all do. Tree, cut and mesh are found in three different ways.
std::string broken_guarantee(const Volume& volume, int levels) {
    for (const isoatlas::CheckResult& check :
         isoatlas::verify_volume(volume, {.levels = levels, .interpolant = Interpolant::trilinear}, one_thread())) {
        if (!check.holds) return check.name + ": " + check.detail;
    }
    return "";
}

void interior_tree_cut_and_mesh_agree() {
    const Grid grid = *arbitrary_grid(6, 100);
    const std::string broken = broken_guarantee(to_volume(grid, isoatlas::ValueType::f64), 12);
    if (!broken.empty()) RC_FAIL(broken);
}

// Any subset of the body points makes a consistent topology; an infinite height is that of the faces.
TEST(Interior, TunnelHeightLeavesTunnelsOut) {
    const Volume noise = isoatlas::make_phantom("noise", {.size = 12});
    Index before = std::numeric_limits<Index>::max();
    for (const double height : {0.0, 0.001, 0.01, 0.05, std::numeric_limits<double>::infinity()}) {
        const isoatlas::VerifyOptions options{.levels = 10, .interpolant = Interpolant::trilinear, .tunnel_height = height};
        for (const isoatlas::CheckResult& check : isoatlas::verify_volume(noise, options, one_thread()))
            EXPECT_TRUE(check.holds) << height << ": " << check.name << ": " << check.detail;
        const Analysis analysis = isoatlas::analyse(noise, {.interpolant = Interpolant::trilinear, .tunnel_height = height}, one_thread());
        EXPECT_LT(analysis.element_count(), before) << height;
        EXPECT_EQ(analysis.tunnel_height(), height);
        before = analysis.element_count();
    }
    EXPECT_EQ(before, isoatlas::analyse(noise, {.interpolant = Interpolant::faces}, one_thread()).element_count());
    EXPECT_THROW((void)isoatlas::analyse(noise, {.interpolant = Interpolant::trilinear, .tunnel_height = -1}), isoatlas::Error);
    EXPECT_THROW((void)isoatlas::cut(noise, 0.5, {.tunnel_height = std::nan("")}), isoatlas::Error);
}

TEST(Interior, TreeCutAndMeshAgreeInNoise) {
    for (const int quantised : {0, 8}) {
        const Volume noise = isoatlas::make_phantom("noise", {.size = 16, .quantise = quantised});
        EXPECT_EQ(broken_guarantee(noise, 20), "");
    }
}

TEST(Interior, TreeCutAndMeshAgreeOnAllOrdersOfACell) {
    Grid grid{3, {2, 2, 2}, std::vector<double>(8)};
    std::iota(grid.value.begin(), grid.value.end(), 0.0);
    std::mt19937_64 random(std::random_device{}());
    do {
        ASSERT_NO_FATAL_FAILURE(for_one_image(grid, random, [](const Grid& image) {
            ASSERT_EQ(broken_guarantee(to_volume(image, isoatlas::ValueType::u8), 15), "") << image;
        }));
    } while (std::next_permutation(grid.value.begin(), grid.value.end()));
}

/// Every volume of a size whose samples take the values 0..levels-1.
void check_all(std::array<Index, 3> size, int levels) {
    Grid grid{3, size, {}};
    grid.value.assign(static_cast<std::size_t>(grid.voxels()), 0);
    std::mt19937_64 random(std::random_device{}());
    for (;;) {
        ASSERT_NO_FATAL_FAILURE(for_one_image(grid, random, [&](const Grid& image) {
            ASSERT_EQ(broken_guarantee(to_volume(image, isoatlas::ValueType::u8), 2 * levels), "") << image;
        }));
        std::size_t digit = 0;
        while (digit < grid.value.size() && grid.value[digit] == levels - 1) grid.value[digit++] = 0;
        if (digit == grid.value.size()) return;
        ++grid.value[digit];
    }
}

TEST(Interior, TreeCutAndMeshAgreeOnEvery2x2x2VolumeOfFourValues) { check_all({2, 2, 2}, 4); }
TEST(Interior, TreeCutAndMeshAgreeOnEvery3x2x2VolumeOfTwoValues) { check_all({3, 2, 2}, 2); }

struct Truth {
    Index isovalues = 0, faces_differ = 0;
    void add(const Grid& grid, const Grid& fine, double gap) {
        const FinerComparison one = compare_with_finer(grid, fine, gap);
        ASSERT_EQ(one.difference, "") << grid;
        isovalues += one.isovalues, faces_differ += one.faces_differ;
    }
};

class Function : public testing::Test {
protected:
    Grid uniform(Index side) {
        return filled(side, [this] { return std::uniform_real_distribution<>(0, 1)(random_); });
    }
    Grid integers(Index side, int levels) {
        return filled(side, [this, levels] { return std::uniform_int_distribution<>(0, levels - 1)(random_); });
    }
    /// Random samples in a layer of Lows.
    Grid closed(Index side) {
        Grid grid = uniform(side);
        for (Index v = 0; v < grid.voxels(); ++v) {
            for (const Index x : grid.voxel(v)) {
                if (x == 0 || x == side - 1) grid.value[v] = -1;
            }
        }
        return grid;
    }

private:
    template <class Next>
    static Grid filled(Index side, Next&& next) {
        Grid grid{3, {side, side, side}, {}};
        for (Index v = 0; v < grid.voxels(); ++v) grid.value.push_back(next());
        return grid;
    }
    std::mt19937_64 random_{20261121};
};

// The truth: the function itself, sampled so finely that faces alone decide. Isovalues that lie well between two critical values.
TEST_F(Function, FinerSamplesHaveTheSameTopology) {
    Truth truth;
    for (const auto& [side, steps, volumes] : {std::tuple<Index, Index, int>{2, 24, 400}, {2, 64, 25}, {3, 16, 60}, {4, 16, 15}}) {
        for (int i = 0; i < volumes; ++i) {
            const Grid grid = uniform(side);
            ASSERT_NO_FATAL_FAILURE(truth.add(grid, finer(grid, steps), 0.01));
        }
    }
    EXPECT_GT(truth.isovalues, 1500);
    EXPECT_GT(truth.faces_differ, 30);  // else the test would prove nothing
}

constexpr double kNarrow = 1e-9;  // rounding moves values of the finer grid by less

TEST_F(Function, CutAtItsSaddlesACellHasTheSameTopology) {
    Truth truth;
    for (int i = 0; i < 300000; ++i) {
        const Grid grid = i % 2 == 0 ? uniform(2) : integers(2, 3 + i % 14);
        ASSERT_NO_FATAL_FAILURE(truth.add(grid, cut_at_saddles(grid), kNarrow));
    }
    EXPECT_GT(truth.isovalues, 500000);
    EXPECT_GT(truth.faces_differ, 25000);
}

TEST_F(Function, CutAtItsSaddlesEveryFourValuedCellHasTheSameTopology) {
    Truth truth;
    for (int code = 0; code < 1 << 16; ++code) {
        Grid grid{3, {2, 2, 2}, {}};
        for (int k = 0; k < 8; ++k) grid.value.push_back(code >> 2 * k & 3);
        ASSERT_NO_FATAL_FAILURE(truth.add(grid, cut_at_saddles(grid), kNarrow));
    }
    EXPECT_GT(truth.faces_differ, 1000);
}

TEST_F(Function, CutAtItsSaddlesAVolumeHasTheSameTopology) {
    Truth truth;
    for (int i = 0; i < 15000; ++i) {
        const Grid grid = i % 3 == 0 ? closed(5) : i % 3 == 1 ? uniform(4) : integers(4, 3 + i % 8);
        ASSERT_NO_FATAL_FAILURE(truth.add(grid, cut_at_saddles(grid), kNarrow));
    }
    EXPECT_GT(truth.isovalues, 200000);
    EXPECT_GT(truth.faces_differ, 50000);
}

void interior_turned_and_mirrored_volumes_have_the_same_changes() {
    const Grid grid = *arbitrary_grid(4, 40);
    const auto changes = [](const Grid& g) { return canonical_text(isoatlas::analyse(to_volume(g), {}, one_thread())); };
    const std::string expected = changes(grid);
    for (const auto& [order, mirror] : turns(grid.rank)) RC_ASSERT(changes(rotated(grid, order, mirror)) == expected);
}

RC_GTEST_PROP(Interior, TreeCutAndMeshAgree, ()) { interior_tree_cut_and_mesh_agree(); }
RC_GTEST_PROP(Interior, TurnedAndMirroredVolumesHaveTheSameChanges, ()) { interior_turned_and_mirrored_volumes_have_the_same_changes(); }

}  // namespace
}  // namespace oracle
