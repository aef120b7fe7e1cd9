// How the volume of a branch depends on the isovalue, where most samples are low.
#include "features/branch_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "features/stable_isovalue.h"

namespace isoatlas {
namespace {

TEST(BranchHistogram, MapsHeightsOfBothSidesThereAndBack) {
    for (const double sign : {1.0, -1.0}) {
        for (const double bend : {0.0, 2.0}) {
            const HeightAxis axis({3, 1000, bend}, sign);
            for (const double value : {3.0, 4.0, 70.0, 1000.0}) EXPECT_NEAR(axis.height(axis.position(sign * value)), sign * value, 1e-9);
            EXPECT_LT(axis.position(-sign * 5), axis.position(-sign * 5 + 1));
        }
    }
}

TEST(BranchHistogram, OfIntegersHasNoBinWithoutAValue) {
    for (const double bend : {0.0, 1.0, 100.0}) {
        BranchHistogram histogram(BranchId(0), 0, 30000, true, HeightAxis({0, 30000, bend}, 1));
        for (int value = 1; value <= 30000; ++value) histogram.add(value, 1);
        EXPECT_GT(*std::ranges::min_element(histogram.added), 0) << bend;
    }
}

// Background up to 51, a body from 200 on, one in it from 20000 on: with equal steps of values the outer boundary lies in three bins.
TEST(BranchHistogram, ThatIsBentShowsBodiesOfLowValues) {
    const auto taus = [](double bend) {
        BranchHistogram histogram(BranchId(0), 0, 30000, true, HeightAxis({0, 30000, bend}, 1));
        for (int i = 0; i <= 100; ++i) histogram.add(1 + i / 2, 20000), histogram.add(200 + i, 3000), histogram.add(20000 + 90 * i, 10);
        std::vector<double> result;
        for (const StableIsovalue& peak : stable_isovalues(histogram)) result.push_back(peak.tau);
        return result;
    };
    const auto is_outer = [](double tau) { return tau > 51 && tau < 200; };
    EXPECT_TRUE(std::ranges::any_of(taus(100), is_outer));
    EXPECT_FALSE(std::ranges::any_of(taus(0), is_outer));
}

TEST(BranchHistogram, HasTheHypervolumeAboveAHeight) {
    BranchHistogram histogram(BranchId(0), 10, 110, false, HeightAxis({10, 110, 0}, 1));
    double above = 0, total = 0;
    for (int i = 0; i < 10000; ++i) {
        const double height = 10 + 0.01 * i;
        histogram.add(height, 2);
        above += 2 * std::max(0.0, height - 80), total += 2 * (height - 10);
    }
    EXPECT_NEAR(histogram.hypervolume_above(80), above, 0.01 * above);
    EXPECT_NEAR(histogram.hypervolume_above(10), total, 0.01 * total);
    EXPECT_EQ(histogram.hypervolume_above(110), 0);
}

}  // namespace
}  // namespace isoatlas
