// What volumes are taken for: fill values, labels, noise that is worth smoothing.
#include "isoatlas/survey.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "features/noise.h"
#include "features/sample_counter.h"
#include "isoatlas/filter.h"

namespace isoatlas {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

Extent cube(std::int64_t size) { return {.rank = 3, .size = {size, size, size}}; }

VolumeInfo info_of(ValueType type, const Extent& extent) {
    VolumeInfo info;
    info.type = type;
    info.extent = extent;
    return info;
}

/// A smooth field of many values between 0 and 250, with noise.
template <class T>
std::vector<T> field(const Extent& extent, double noise = 5) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0, std::max(noise, 1e-9));
    std::vector<T> samples;
    for (std::int64_t i = 0; i < extent.voxels(); ++i) {
        const Index3 p = extent.voxel(i);
        const double value = 125 + 100 * std::sin(0.3 * static_cast<double>(p[0])) * std::cos(0.25 * static_cast<double>(p[1] + p[2]));
        samples.push_back(static_cast<T>(std::clamp(value + normal(random), 1.0, 249.0)));
    }
    return samples;
}

/// The first slices become the value.
template <class T>
std::vector<T> with(std::vector<T> samples, double value, double part = 0.3) {
    std::fill_n(samples.begin(), static_cast<std::ptrdiff_t>(part * static_cast<double>(samples.size())), static_cast<T>(value));
    return samples;
}

template <class T>
std::optional<FillValue> found(const std::vector<T>& samples, const Extent& extent, const Calibration& calibration = {}) {
    VolumeInfo info = info_of(value_type_of<T>, extent);
    info.calibration = calibration;
    return fill_value(survey_of<T>(samples, extent), info);
}

TEST(FillValue, TheUsualNumbersAreFound) {
    const Extent extent = cube(24);
    for (const double value : {1e20, 9.96921e36, static_cast<double>(std::numeric_limits<float>::max()), -9999.0, -99999.0, -3.4e38}) {
        const std::optional<FillValue> fill = found(with(field<float>(extent), value), extent);
        ASSERT_TRUE(fill) << value;
        EXPECT_EQ(static_cast<float>(fill->value), static_cast<float>(value));
        EXPECT_TRUE(fill->is_known);
        EXPECT_GE(fill->low, 1);
        EXPECT_LE(fill->high, 249);
    }
    for (const double value : {-32768.0, -32767.0, 32767.0, -9999.0, -2000.0, -3024.0}) {
        const std::optional<FillValue> fill = found(with(field<std::int16_t>(extent), value), extent);
        ASSERT_TRUE(fill) << value;
        EXPECT_EQ(fill->value, value);
    }
    EXPECT_TRUE(found(with(field<std::uint16_t>(extent), 65535), extent));
    EXPECT_TRUE(found(with(field<double>(extent), 9.969209968386869e36), extent));
    // few samples, which are -2000 only after the calibration
    EXPECT_FALSE(found(with(field<std::int16_t>(extent), -976, 0.005), extent));
    EXPECT_TRUE(found(with(field<std::int16_t>(extent), -976, 0.005), extent, {.slope = 1, .intercept = -1024}));
}

TEST(FillValue, OneSampleOfAUsualNumberIsEnough) {
    const Extent extent = cube(24);
    EXPECT_TRUE(found(with(field<float>(extent), 1e20, 1.5 / static_cast<double>(extent.voxels())), extent));
}

TEST(FillValue, APlateauFarFromTheRestIsFound) {
    const Extent extent = cube(24);
    const std::optional<FillValue> fill = found(with(field<float>(extent), -1234), extent);
    ASSERT_TRUE(fill);
    EXPECT_FALSE(fill->is_known);
    EXPECT_EQ(fill->value, -1234);
    EXPECT_FALSE(found(with(field<float>(extent), -1234, 0.001), extent)) << "too few";
    EXPECT_FALSE(found(with(field<float>(extent), -100), extent)) << "too near";
}

TEST(FillValue, OrdinaryVolumesHaveNone) {
    const Extent extent = cube(24);
    EXPECT_FALSE(found(field<float>(extent), extent));
    EXPECT_FALSE(found(with(field<float>(extent), 0), extent)) << "a background of 0";
    EXPECT_FALSE(found(with(field<std::uint8_t>(extent), 255), extent)) << "8 bits";
    EXPECT_FALSE(found(with(field<std::uint16_t>(extent), 300), extent)) << "saturated";
    std::vector<std::int16_t> whole(static_cast<std::size_t>(extent.voxels()));
    std::mt19937 random(3);
    for (std::int16_t& sample : whole) sample = static_cast<std::int16_t>(random());
    whole[5] = -32768, whole[6] = 32767;
    EXPECT_FALSE(found(whole, extent)) << "the whole range of the type is used";
    EXPECT_FALSE(found(std::vector<float>(static_cast<std::size_t>(extent.voxels()), -9999), extent)) << "one value";
    std::vector<float> two(static_cast<std::size_t>(extent.voxels()), 1);
    EXPECT_FALSE(found(with(two, -9999), extent)) << "two values are a binary volume";
}

RC_GTEST_PROP(FillValue, IsAnEndAndTheOthersAreTheRest, ()) {
    const Extent extent{.rank = 3, .size = {*rc::gen::inRange(1, 9), *rc::gen::inRange(1, 9), *rc::gen::inRange(1, 9)}};
    std::vector<std::int16_t> samples(static_cast<std::size_t>(extent.voxels()));
    const int range = *rc::gen::inRange(1, 400);
    for (std::int16_t& sample : samples) sample = static_cast<std::int16_t>(*rc::gen::inRange(-range, range));
    const auto value = *rc::gen::elementOf(std::vector<std::int16_t>{-32768, -9999, -2000, 32767, 0, 5, -5000});
    for (std::int64_t i = *rc::gen::inRange<std::int64_t>(0, extent.voxels()); i < extent.voxels(); ++i) samples[i] = value;
    std::vector<std::int16_t> rest;
    std::ranges::copy_if(samples, std::back_inserter(rest), [&](std::int16_t sample) { return sample != value; });
    const std::optional<FillValue> fill = found(samples, extent);
    if (!fill) return;
    const auto [low, high] = std::ranges::minmax(samples);
    RC_ASSERT(fill->value == low || fill->value == high);
    RC_ASSERT(fill->value != 0);
    RC_ASSERT(fill->count == std::ranges::count(samples, static_cast<std::int16_t>(fill->value)));
    std::erase(samples, static_cast<std::int16_t>(fill->value));
    const auto [lowest, highest] = std::ranges::minmax(samples);
    RC_ASSERT(fill->low == lowest);
    RC_ASSERT(fill->high == highest);
    RC_ASSERT(std::min(std::abs(fill->value - lowest), std::abs(fill->value - highest)) * 10 > highest - lowest);
}

RC_GTEST_PROP(SampleCounts, AreThoseOfBruteForce, ()) {
    const Extent extent{.rank = 3, .size = {*rc::gen::inRange(1, 7), *rc::gen::inRange(1, 7), *rc::gen::inRange(1, 5)}};
    std::vector<float> samples(static_cast<std::size_t>(extent.voxels()));
    const int values = *rc::gen::inRange(1, 6);
    for (float& sample : samples) {
        sample = static_cast<float>(*rc::gen::inRange(0, values));
        if (*rc::gen::inRange(0, 20) == 0) sample = std::numeric_limits<float>::quiet_NaN();
    }
    std::map<float, std::int64_t> counts;
    std::int64_t missing = 0, pairs = 0, equal = 0, skipping = 0;
    for (const float sample : samples) std::isnan(sample) ? ++missing : ++counts[sample];
    std::vector<std::pair<float, float>> unequal;
    for (std::int64_t i = 0; i + 1 < extent.voxels(); ++i) {
        const auto [a, b] = std::minmax(samples[i], samples[i + 1]);
        if (extent.voxel(i)[0] + 1 == extent.size[0] || std::isnan(samples[i]) || std::isnan(samples[i + 1])) continue;
        ++pairs;
        equal += a == b;
        if (a != b) skipping += std::distance(counts.find(a), counts.find(b)) > 1;
    }
    const SampleSurvey survey = survey_of<float>(samples, extent);
    RC_ASSERT(survey.missing == missing);
    RC_ASSERT(survey.samples == extent.voxels() - missing);
    RC_ASSERT(survey.values == counts.size());
    if (counts.empty()) return;
    const auto after_first = std::next(counts.begin());
    const auto before_last = std::next(counts.rbegin());
    RC_ASSERT(survey.low.value == counts.begin()->first);
    RC_ASSERT(survey.low.count == counts.begin()->second);
    RC_ASSERT(survey.low.next == (counts.size() > 1 ? static_cast<double>(after_first->first) : kNever));
    RC_ASSERT(survey.high.value == counts.rbegin()->first);
    RC_ASSERT(survey.high.count == counts.rbegin()->second);
    RC_ASSERT(survey.high.next == (counts.size() > 1 ? static_cast<double>(before_last->first) : -kNever));
    const auto part = [](std::int64_t some, std::int64_t all) {
        return all == 0 ? 0 : static_cast<double>(some) / static_cast<double>(all);
    };
    RC_ASSERT(survey.likeness.equal == part(equal, pairs));
    RC_ASSERT(survey.likeness.skipping == part(skipping, pairs - equal));
}

/// Balls of the labels 1, 2, ... in a background of 0.
template <class T>
std::vector<T> balls(const Extent& extent, int count) {
    std::mt19937 random(11);
    std::vector<T> samples(static_cast<std::size_t>(extent.voxels()), T{0});
    for (int label = 1; label <= count; ++label) {
        const Index3 middle{static_cast<std::int64_t>(random() % extent.size[0]), static_cast<std::int64_t>(random() % extent.size[1]),
                            static_cast<std::int64_t>(random() % extent.size[2])};
        for (std::int64_t i = 0; i < extent.voxels(); ++i) {
            const Index3 d = extent.voxel(i) - middle;
            if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < 200) samples[static_cast<std::size_t>(i)] = static_cast<T>(label);
        }
    }
    return samples;
}

TEST(Labels, AreFewWholeNumbersWithEqualNeighbours) {
    const Extent extent = cube(64);
    for (const int count : {3, 12}) {
        EXPECT_TRUE(survey_of<std::uint8_t>(balls<std::uint8_t>(extent, count), extent).likeness.are_labels) << count;
        EXPECT_TRUE(survey_of<float>(balls<float>(extent, count), extent).likeness.are_labels) << count;
    }
}

TEST(Labels, AreNotBinaryNorQuantisedNorNoisy) {
    const Extent extent = cube(64);
    EXPECT_FALSE(survey_of<std::uint8_t>(balls<std::uint8_t>(extent, 1), extent).likeness.are_labels) << "two values";
    std::vector<std::uint8_t> steps = field<std::uint8_t>(extent, 0);
    for (std::uint8_t& sample : steps) sample = static_cast<std::uint8_t>(sample / 40);
    EXPECT_FALSE(survey_of<std::uint8_t>(steps, extent).likeness.are_labels) << "a field of few values";
    EXPECT_FALSE(survey_of<std::uint8_t>(field<std::uint8_t>(extent, 5), extent).likeness.are_labels) << "noise";
    std::vector<float> halves = balls<float>(extent, 12);
    for (float& sample : halves) sample /= 2;
    EXPECT_FALSE(survey_of<float>(halves, extent).likeness.are_labels) << "no whole numbers";
    std::vector<std::uint8_t> sparse(static_cast<std::size_t>(extent.voxels()));
    std::mt19937 random(5);
    for (std::size_t i = 0; i < sparse.size() / 80; ++i) sparse[random() % sparse.size()] = static_cast<std::uint8_t>(random());
    EXPECT_FALSE(survey_of<std::uint8_t>(sparse, extent).likeness.are_labels) << "few bright samples";
}

TEST(Smoothing, LeavesWhatItSaysOfIndependentNoise) {
    const Extent extent = cube(64);
    for (const Vec3& spacing : {Vec3{1, 1, 1}, Vec3{0.5, 0.5, 2}}) {
        for (const double sigma : {0.5, 1.0, 1.75}) {
            Volume volume = make_volume(extent, ValueType::f32);
            volume.info.geometry.spacing = spacing;
            std::mt19937 random(17);
            std::normal_distribution<float> normal(0, 10);
            for (float& sample : volume.samples<float>()) sample = normal(random);
            const Volume filtered = gaussian_filter(volume, sigma * spacing[0]);
            double squares = 0;
            for (const float sample : filtered.samples<float>()) squares += static_cast<double>(sample) * static_cast<double>(sample);
            const double left = std::sqrt(squares / static_cast<double>(extent.voxels())) / 10;
            EXPECT_NEAR(left / noise_left_by(volume.info, sigma * spacing[0]), 1, 0.15) << sigma;
        }
    }
}

TEST(Smoothing, IsAdvisedForStrongNoiseOnly) {
    VolumeInfo info = info_of(ValueType::f32, cube(32));
    EXPECT_EQ(advised_sigma(info, 3, 100), 0);
    EXPECT_EQ(advised_sigma(info, 1, 0), 0);
    double before = 0;
    for (const double noise : {3.1, 5.0, 8.0, 12.0, 20.0, 60.0}) {
        const double sigma = advised_sigma(info, noise, 100);
        EXPECT_GE(sigma, std::max(0.5, before));
        EXPECT_LE(sigma, 2);
        EXPECT_TRUE(sigma == 2 || noise * noise_left_by(info, sigma) <= 0.75);
        before = sigma;
    }
    info.geometry.spacing = {0.1, 0.1, 0.4};
    EXPECT_GT(advised_sigma(info, 5, 100), 0);
    EXPECT_LE(advised_sigma(info, 5, 100), 0.2);
    info.geometry.coordinates[0] = {0, 1, 3};
    EXPECT_EQ(advised_sigma(info, 5, 100), 0) << "uneven steps cannot be filtered";
}

}  // namespace
}  // namespace isoatlas
