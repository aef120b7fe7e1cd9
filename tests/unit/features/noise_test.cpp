// The noise of volumes whose noise is known: none, the same everywhere, growing with the value, beside edges and slopes.
#include "features/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "isoatlas/volume.h"

namespace isoatlas {
namespace {

using Field = std::function<double(const Index3&)>;

/// About normal: the sum of twelve uniform numbers.
class Normal {
public:
    double operator()() {
        double sum = -6;
        for (int i = 0; i < 12; ++i)
            sum += static_cast<double>((state_ = state_ * 6364136223846793005U + 1442695040888963407U) >> 11) * 0x1p-53;
        return sum;
    }

private:
    std::uint64_t state_ = 12345;
};

/// field + sigma(field) * noise
Volume volume_of(std::int64_t size, const Field& field, const std::function<double(double)>& sigma) {
    Volume volume = make_volume({3, {size, size, size}}, ValueType::f32, {});
    auto* samples = reinterpret_cast<float*>(volume.bytes.data());
    Normal normal;
    for (std::int64_t v = 0; v < volume.info.extent.voxels(); ++v) {
        const double value = field(volume.info.extent.voxel(v));
        samples[v] = static_cast<float>(value + sigma(value) * normal());
    }
    return volume;
}

double boxes(const Index3& p) { return 100.0 * static_cast<double>((p[0] / 12 + p[1] / 12 + p[2] / 12) % 5); }
double slope(const Index3& p) { return 4.0 * static_cast<double>(p[0]) + 3.0 * static_cast<double>(p[1]); }

TEST(Noise, OfCleanBoxesIsNone) {
    const Volume volume = volume_of(48, boxes, [](double) { return 0; });
    EXPECT_EQ(estimate_noise(volume), 0);
    EXPECT_EQ(fit_noise(volume).at(300), 0);
}

double waves(const Index3& p) { return 100 * std::sin(0.4 * static_cast<double>(p[0])) * std::cos(0.3 * static_cast<double>(p[1] + p[2])); }

TEST(Noise, TheFinestDifferenceSeesNoStructure) {
    EXPECT_EQ(finest_noise(volume_of(48, boxes, [](double) { return 0; })), 0);
    for (const Field& field : {Field(boxes), Field(slope), Field(waves)}) {
        EXPECT_LT(finest_noise(volume_of(48, field, [](double) { return 0; })), 0.2);
        EXPECT_NEAR(finest_noise(volume_of(48, field, [](double) { return 5; })), 5, 0.5);
    }
    EXPECT_GT(estimate_noise(volume_of(48, waves, [](double) { return 0; })), 1) << "the plain estimate does";
}

TEST(Noise, OfOneStrengthIsFoundAndHasNoSlope) {
    for (const Field& field : {Field(boxes), Field(slope)}) {
        const Volume volume = volume_of(48, field, [](double) { return 5; });
        const NoiseModel model = fit_noise(volume);
        EXPECT_EQ(model.slope, 0);
        EXPECT_NEAR(model.at(0), 5, 1);
        EXPECT_EQ(model.at(0), model.at(400));
    }
}

TEST(Noise, ThatGrowsWithTheValueIsFound) {
    for (const Field& field : {Field(boxes), Field(slope)}) {
        const auto sigma = [](double value) { return 2 + 0.05 * value; };
        const Volume volume = volume_of(48, field, sigma);
        const NoiseModel model = fit_noise(volume);
        EXPECT_GT(model.slope, 0);
        for (const double value : {50.0, 150.0, 250.0, 300.0})  // where it is weak, that of the whole volume counts
            EXPECT_NEAR(model.at(value) / std::max(model.sigma, sigma(value)), 1, 0.3) << value;
        EXPECT_GE(model.at(0), model.sigma);
        EXPECT_EQ(model.at(1e6), model.at(1e7));  // nothing is known beyond the brightest neighbourhoods
    }
}

TEST(Noise, OfSmallAndFlatVolumesIsFinite) {
    for (const std::int64_t size : {1, 2, 3, 5}) {
        for (const double strength : {0.0, 1.0}) {
            const NoiseModel model = fit_noise(volume_of(size, boxes, [&](double) { return strength; }));
            EXPECT_TRUE(std::isfinite(model.at(7)));
            EXPECT_GE(model.at(7), 0);
        }
    }
}

}  // namespace
}  // namespace isoatlas
