// Surfaces never cross themselves: decided with exact predicates, in memory and after rounding to float32.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>

#include "isoatlas/isoatlas.h"
#include "oracle/exact/crossings.h"
#include "oracle/exact/embedding.h"
#include "oracle/tunnels.h"

namespace oracle {
namespace {

using isoatlas::Extent;
using isoatlas::Volume;

constexpr std::uint64_t kSeed = 20261122;

/// The same numbers on every machine: std::uniform_real_distribution does not promise that.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Runs a test as often as the environment asks, with a seed of its own each time, and says what it looked at.
template <class Test>
void repeat(const char* name, Test&& test) {
    EmbeddingTally tally;
    for (int i = 0; i < repetitions(); ++i) {
        const std::uint64_t seed = kSeed + static_cast<std::uint64_t>(i);
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937_64 random(seed);
        test(random, tally);
        if (testing::Test::HasFailure()) break;
    }
    std::cout << name << ": " << tally.text() << "\n";
}

template <class Sample>
Volume cube(std::int64_t side, Sample&& sample) {
    const Extent extent{3, {side, side, side}};
    std::vector<float> samples;
    for (std::int64_t i = 0; i < extent.voxels(); ++i) {
        const auto p = extent.voxel(i);
        samples.push_back(static_cast<float>(sample((p[0] + p[1] + p[2]) % 2 != 0)));
    }
    return isoatlas::make_volume<float>(extent, samples);
}

double some_sample(const Volume& volume, std::mt19937_64& random) {
    const auto samples = volume.samples<float>();
    return static_cast<double>(samples[random() % samples.size()]);
}

const std::vector<Placement> kTwoPlacements{Placement::voxel, Placement::oblique};
const std::vector<Placement> kAllPlacements{Placement::voxel, Placement::spaced, Placement::oblique};

TEST(Surfaces, OfWhiteNoiseAreEmbedded) {
    repeat("white noise", [](std::mt19937_64& random, EmbeddingTally& tally) {
        for (const std::int64_t side : {10, 13, 16}) {
            const Volume noise = cube(side, [&](bool) { return uniform(random); });
            EXPECT_EQ(embedding_fault(noise, {0.5, some_sample(noise, random)}, kTwoPlacements, tally), "") << "side " << side;
        }
        const Volume grey = cube(12, [&](bool) { return std::floor(8 * uniform(random)); });
        EXPECT_EQ(embedding_fault(grey, {4, 3.5}, kAllPlacements, tally), "");
    });
}

TEST(Surfaces, OfCheckerboardsAreEmbedded) {
    repeat("checkerboards", [](std::mt19937_64& random, EmbeddingTally& tally) {
        const Volume plain = cube(10, [](bool odd) { return odd; });
        EXPECT_EQ(embedding_fault(plain, {1, 0.5, 1e-4}, kAllPlacements, tally), "");
        for (const double noise : {1.0, 0.1, 1e-5}) {
            const Volume board = cube(10, [&](bool odd) { return odd + noise * uniform(random); });
            const double between = (1 + noise) / 2;  // here many neighbouring cells have tunnels
            EXPECT_EQ(embedding_fault(board, {between, some_sample(board, random)}, kTwoPlacements, tally), "") << "noise " << noise;
        }
        const Volume tied = cube(11, [&](bool odd) { return 3 * odd + std::floor(3 * uniform(random)); });
        EXPECT_EQ(embedding_fault(tied, {3, 2, 2.5}, kTwoPlacements, tally), "");
    });
}

TEST(Surfaces, OfSmallIntegersAreEmbedded) {
    repeat("small integers", [](std::mt19937_64& random, EmbeddingTally& tally) {
        const Volume four = cube(12, [&](bool) { return std::floor(4 * uniform(random)); });
        EXPECT_EQ(embedding_fault(four, {1, 2, 3, 1.5}, kTwoPlacements, tally), "");
        const Volume eight = cube(10, [&](bool) { return std::floor(8 * uniform(random)); });
        EXPECT_EQ(embedding_fault(eight, {1, 4, 7, 3.999999}, kAllPlacements, tally), "");
    });
}

// Most hits lie close to voxels: long, thin triangles, and sheets close to each other.
TEST(Surfaces, OfHeavyTailsAreEmbedded) {
    repeat("heavy tails", [](std::mt19937_64& random, EmbeddingTally& tally) {
        const Volume wide = cube(10, [&](bool) { return std::exp(40 * (uniform(random) - 0.5)); });
        EXPECT_EQ(embedding_fault(wide, {1, 1.01}, kTwoPlacements, tally), "");
        const Volume odd_power = cube(10, [&](bool) { return std::pow(2 * uniform(random) - 1, 15); });
        EXPECT_EQ(embedding_fault(odd_power, {0, 1e-4}, kAllPlacements, tally), "");
        const Volume near_ties = cube(10, [&](bool) { return std::floor(3 * uniform(random)) + 1e-5 * uniform(random); });
        EXPECT_EQ(embedding_fault(near_ties, {1, 1.000005, some_sample(near_ties, random)}, kTwoPlacements, tally), "");
    });
}

/// Isovalues at both ends of the life of a tunnel and between.
std::vector<double> stages_of(const TunnelSample& tunnel) {
    const double life = tunnel.high - tunnel.low;
    return {std::nextafter(tunnel.low, 2),
            tunnel.low + 1e-6 * life,
            tunnel.low + 0.02 * life,
            tunnel.low + life / 2,
            tunnel.high - 0.02 * life,
            tunnel.high - 1e-6 * life,
            tunnel.high};
}

/// A tunnel cell alone, or in the middle of noise.
Volume around(const TunnelSample& tunnel, bool alone, std::mt19937_64& random) {
    const Extent extent{3, alone ? isoatlas::Index3{2, 2, 2} : isoatlas::Index3{4, 4, 4}};
    std::vector<double> samples(static_cast<std::size_t>(extent.voxels()));
    for (double& sample : samples) sample = 2 * uniform(random) - 1;
    const int first = alone ? 0 : 1;
    for (int k = 0; k < 8; ++k) samples[extent.index(first + (k & 1), first + (k >> 1 & 1), first + (k >> 2))] = tunnel.value[k];
    return isoatlas::make_volume<double>(extent, samples);
}

TEST(Surfaces, OfTunnelsOfEveryShapeAreEmbeddedAtEveryStage) {
    repeat("tunnels", [](std::mt19937_64& random, EmbeddingTally& tally) {
        for (int trial = 0; trial < 12 * 25; ++trial) {
            const int shape = trial % 6;
            const TunnelSample tunnel = random_tunnel(shape, trial / 6 % 2 == 0, random);
            const Volume volume = around(tunnel, trial / 12 % 2 == 0, random);
            const auto before = tally.tunnels;
            ASSERT_EQ(embedding_fault(volume, stages_of(tunnel), kAllPlacements, tally), "") << "trial " << trial;
            EXPECT_GT(tally.tunnels[shape], before[shape]) << "trial " << trial;
        }
    });
}

// Else the tests above would prove nothing.
TEST(Surfaces, ThatAreBrokenAreFound) {
    std::mt19937_64 random(kSeed);
    isoatlas::Surface surface = isoatlas::extract(cube(6, [&](bool) { return uniform(random); }), 0.5);
    ASSERT_TRUE(find_crossings(surface.points, surface.triangles).none());
    const std::array<std::int64_t, 3> triangle = surface.triangles[100];

    isoatlas::Surface pierced = surface;  // a point is pulled through the sheets of the next cells
    for (double& x : pierced.points[triangle[0]]) x += 1.5;
    EXPECT_GT(find_crossings(pierced.points, pierced.triangles).crossings, 0);

    isoatlas::Surface folded = surface;  // two triangles on either side of an edge, one flapped over onto the other
    const auto first = static_cast<std::int64_t>(folded.points.size());
    folded.points.insert(folded.points.end(), {{50, 0, 0}, {52, 0, 0}, {51, 2, 0}, {51, 1, 0}});
    folded.triangles.insert(folded.triangles.end(), {{first, first + 1, first + 2}, {first, first + 1, first + 3}});
    EXPECT_EQ(find_crossings(folded.points, folded.triangles).crossings, 1);

    isoatlas::Surface overlapping = surface;  // coplanar, without a common point
    overlapping.points.insert(overlapping.points.end(), {{50, 0, 0}, {52, 0, 0}, {51, 2, 0}, {51, 1, 0}, {53, 1, 0}, {52, 3, 0}});
    overlapping.triangles.insert(overlapping.triangles.end(), {{first, first + 1, first + 2}, {first + 3, first + 4, first + 5}});
    EXPECT_EQ(find_crossings(overlapping.points, overlapping.triangles).crossings, 1);

    isoatlas::Surface touching = surface;  // a corner of one triangle lies in the other, to the last bit
    touching.points.insert(touching.points.end(), {{50, 0, 0}, {52, 0, 0}, {51, 2, 0}, {51, 1, 0}, {51, 1, 1}, {52, 1, 1}});
    touching.triangles.insert(touching.triangles.end(), {{first, first + 1, first + 2}, {first + 3, first + 4, first + 5}});
    EXPECT_EQ(find_crossings(touching.points, touching.triangles).crossings, 1);
    touching.points[static_cast<std::size_t>(first + 3)][2] = std::numeric_limits<double>::denorm_min();
    EXPECT_EQ(find_crossings(touching.points, touching.triangles).crossings, 0);

    isoatlas::Surface flat = surface;
    flat.points.insert(flat.points.end(), {{50, 0, 0}, {52, 0, 0}, {51, 0, 0}});
    flat.triangles.push_back({first, first + 1, first + 2});
    EXPECT_EQ(find_crossings(flat.points, flat.triangles).flat, 1);
}

}  // namespace
}  // namespace oracle
