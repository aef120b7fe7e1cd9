// The axis of isovalues, linear or bent.
#include "field/axis_scale.h"

#include <gtest/gtest.h>

#include <numeric>

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

}  // namespace
}  // namespace isoatlas
