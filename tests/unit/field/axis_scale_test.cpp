// The axis of isovalues, linear or bent.
#include "field/axis_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>

namespace isoatlas {
namespace {

TEST(AxisScale, MapsThereAndBack) {
    for (const AxisScale& scale : {AxisScale{-5, 20, 0}, AxisScale{-5, 20, 0.25}}) {
        for (const double tau : {-5.0, 0.0, 3.5, 20.0}) EXPECT_NEAR(scale.tau(scale.position(tau)), tau, 1e-9);
        EXPECT_EQ(scale.position(-5), 0);
        EXPECT_NEAR(scale.position(20), 1, 1e-12);
    }
    EXPECT_EQ((AxisScale{3, 3, 0}.position(3)), 0);
}

TEST(AxisScale, OfSamplesIsThatOfTheirCounts) {
    std::vector<float> samples(1000);
    std::iota(samples.begin(), samples.end(), 0.0F);
    for (const float highest : {999.0F, 1e6F}) {
        samples.back() = highest;
        const Volume volume = make_volume<float>({3, {1000, 1, 1}}, samples);
        const std::vector<double> edges = axis_edges(0, highest);
        std::vector<std::int64_t> counts(edges.size() - 1, 0);
        for (const float sample : samples) {
            for (std::size_t i = 0; i < counts.size(); ++i)
                counts[i] += edges[i] <= sample && (sample < edges[i + 1] || (i + 1 == counts.size() && sample == edges[i + 1]));
        }
        EXPECT_EQ(axis_scale(VolumeView(volume)).bend, axis_scale(0, highest, counts).bend);
        EXPECT_EQ(axis_scale(VolumeView(volume)).bend > 0, highest > 1000);
    }
    const Volume constant = make_volume<float>({3, {3, 1, 1}}, std::vector<float>{7, 7, 7});
    EXPECT_EQ(axis_scale(VolumeView(constant)).bend, 0);
    EXPECT_TRUE(axis_edges(7, 7).empty());
}

TEST(AxisScale, OfBoundsIsThatOfTheCountsOrNone) {
    std::mt19937 random(5);
    int known = 0, bent = 0;
    constexpr int kRounds = 300;
    const std::vector<double> edges = axis_edges(0, 1);
    for (int round = 0; round < kRounds; ++round) {
        const double mean = std::pow(10, std::uniform_real_distribution<double>(-3, -0.5)(random));
        std::vector<double> samples{1};
        while (samples.size() < 2000) samples.push_back(std::min(1.0, std::exponential_distribution<double>(1 / mean)(random)));
        const std::int64_t slack = round % 50;
        std::vector<Bounds> bounds;
        std::vector<std::int64_t> counts;
        std::int64_t before = 0;
        for (const double edge : edges) {
            const std::int64_t above = std::ranges::count_if(samples, [&](double sample) { return sample >= edge; });
            if (!bounds.empty()) counts.push_back(before - above);
            bounds.push_back({std::max<std::int64_t>(above - slack, 0), above + slack});
            before = above;
        }
        counts.back() += before;
        const AxisScale right = axis_scale(0, 1, counts);
        const std::optional<AxisScale> found = axis_scale(0, 1, bounds);
        EXPECT_TRUE(!found || found->bend == right.bend) << mean << ", " << slack;
        known += found.has_value() ? 1 : 0, bent += right.bend > 0 ? 1 : 0;
    }
    EXPECT_GT(known, kRounds / 6);
    EXPECT_LT(known, kRounds);
    EXPECT_GT(bent, kRounds / 6);
    EXPECT_LT(bent, kRounds - kRounds / 6);
}

}  // namespace
}  // namespace isoatlas
