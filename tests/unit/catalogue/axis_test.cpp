// The axis of a page, the histogram over it, and curves with few points.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "catalogue/histogram.h"
#include "catalogue/page_axis.h"
#include "catalogue/thin_curve.h"
#include "oracle/stores.h"

namespace isoatlas {
namespace {

class PageAxis : public oracle::Stores {
protected:
    template <class T>
    Atlas atlas_of(const std::vector<T>& samples) {
        build_atlas(path_, make_volume<T>({3, {static_cast<std::int64_t>(samples.size()), 1, 1}}, samples));
        return Atlas(path_);
    }
};

TEST_F(PageAxis, IsBentWhereNearlyAllSamplesAreLow) {
    std::vector<float> samples(1000);
    std::iota(samples.begin(), samples.end(), 0.0F);
    EXPECT_EQ(page_axis(atlas_of(samples)).bend, 0);
    samples.back() = 1e6F;
    const AxisScale bent = page_axis(atlas_of(samples));
    EXPECT_NEAR(bent.bend, 500, 50);
    EXPECT_NEAR(bent.position(999), 0.17, 0.02);  // linear: 0.001
    EXPECT_EQ(page_axis(atlas_of<float>({7, 7, 7})).bend, 0);
}

TEST_F(PageAxis, HistogramCountsEverySampleOnce) {
    const Histogram few = make_histogram(atlas_of<std::uint8_t>({4, 5, 5, 7, 7, 7}), {4, 7, 0});
    EXPECT_EQ(few.counts, (std::vector<std::int64_t>{1, 2, 0, 3}));
    EXPECT_EQ(few.edges, (std::vector<double>{3.5, 4.5, 5.5, 6.5, 7.5}));
    std::mt19937 random(3);
    std::vector<float> samples(5000);
    for (float& sample : samples) sample = std::uniform_real_distribution<float>(0, 1)(random);
    const auto [low, high] = std::ranges::minmax(samples);
    const Atlas atlas = atlas_of(samples);
    for (const double bend : {0.0, 0.01}) {
        const Histogram many = make_histogram(atlas, {low, high, bend});
        EXPECT_EQ(std::reduce(many.counts.begin(), many.counts.end()), 5000);
        EXPECT_EQ(many.edges.size(), many.counts.size() + 1);
        EXPECT_TRUE(std::ranges::is_sorted(many.edges));
    }
    EXPECT_EQ(make_histogram(atlas_of<float>({2, 2}), {2, 2, 0}).counts.front(), 0);
}

TEST_F(PageAxis, TheCensusOfTheStoreIsSufficient) {
    std::mt19937 random(4);
    std::vector<float> samples(200000);
    for (float& sample : samples) sample = std::normal_distribution<float>(5, 2)(random);
    const Atlas atlas = atlas_of(samples);
    const AxisScale scale = page_axis(atlas);
    const Histogram histogram = make_histogram(atlas, scale);
    EXPECT_EQ(atlas.reads().bricks, 0);
    EXPECT_EQ(histogram.counts, atlas.histogram(histogram.edges));
    EXPECT_GT(atlas.reads().bricks, 0);
    const double wide = (scale.high - scale.low) / 160;
    for (std::size_t i = 0; i < histogram.edges.size(); ++i)
        EXPECT_NEAR(histogram.edges[i], scale.low + wide * static_cast<double>(i), wide / 4) << i;
}

TEST(ThinCurve, KeepsTheEndsAndFewPointsBetween) {
    SelectionCurve curve{"hypervolume", {}, {}, 500, 500};
    for (std::int64_t n = 1; n <= 100000; ++n) curve.threshold.push_back(1.0 / static_cast<double>(n)), curve.kept.push_back(n);
    const SelectionCurve thin = thin_curve(curve, 100);
    EXPECT_LE(thin.kept.size(), 100U);
    EXPECT_GT(thin.kept.size(), 60U);
    EXPECT_EQ(thin.kept.front(), 1);
    EXPECT_EQ(thin.kept.back(), 100000);
    EXPECT_EQ(thin.automatic_kept, 500);
    for (std::size_t i = 0; i < thin.kept.size(); ++i) EXPECT_EQ(thin.threshold[i], 1.0 / static_cast<double>(thin.kept[i]));
    EXPECT_EQ(thin_curve(curve, 200000).kept.size(), 100000U);
}

}  // namespace
}  // namespace isoatlas
