// Isovalues at which the volume of a body hardly depends on the isovalue.
#include "features/stable_isovalue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace isoatlas {
namespace {

/// Voxels per bin: two bodies and the background have edges, between them little happens.
std::vector<double> body_edges(double background) {
    std::vector<double> added(256, background);
    for (int k = -6; k <= 6; ++k) {
        const double part = std::exp(-k * k / 8.0);
        added[200 + k] += 20000 * part, added[100 + k] += 200000 * part, added[10 + k] += 1e6 * part;
    }
    return added;
}

TEST(StableIsovalues, AreBetweenTheEdgesOfBodies) {
    const std::vector<StableIsovalue> peaks = stable_isovalues(body_edges(40), 0, 256);
    ASSERT_GE(peaks.size(), 2U);
    bool between = false, below = false;
    for (const StableIsovalue& peak : peaks) {
        between = between || (peak.tau > 106 && peak.tau < 194);
        below = below || (peak.tau > 16 && peak.tau < 94);
        EXPECT_GE(peak.prominence, std::log(1.5));
        EXPECT_GT(peak.volume, 0);
    }
    EXPECT_TRUE(between && below);
    for (std::size_t i = 1; i < peaks.size(); ++i) EXPECT_GE(peaks[i - 1].prominence, peaks[i].prominence);
}

// Values drawn evenly from the range: gaps between them are chance.
TEST(StableIsovalues, OfAFewRandomVoxelsAreNotTrusted) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        std::vector<double> added(256, 0);
        std::uint32_t state = seed;
        for (int i = 0; i < 300; ++i) state = state * 1664525 + 1013904223, added[state >> 24] += 1;
        std::size_t finite = 0;
        for (const StableIsovalue& peak : stable_isovalues(added, 0, 256)) finite += std::isfinite(peak.prominence);
        EXPECT_LE(finite, 1U);
    }
}

TEST(StableIsovalues, OfAConstantVolumeAreNone) {
    EXPECT_TRUE(stable_isovalues(std::vector<double>{1000}, 5, 5).empty());
    EXPECT_TRUE(stable_isovalues(std::vector<double>(256, 0), 0, 1).empty());
}

}  // namespace
}  // namespace isoatlas
