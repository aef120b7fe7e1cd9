// Fewer triangles, and the same components, tunnels and cavities.
#include "preview/collapse_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

void expect_same_topology(const Surface& whole, std::size_t max) {
    const Surface coarse = collapse_edges(whole, max);
    EXPECT_TRUE(has_same_topology(whole, coarse));
    const SurfaceReport report = inspect(coarse.points, coarse.triangles);
    EXPECT_TRUE(report.is_closed() && report.is_manifold() && report.is_oriented());
    EXPECT_EQ(report.unused_points, 0);
    EXPECT_EQ(coarse.points.size(), coarse.normals.size());
    EXPECT_LE(coarse.triangles.size(), whole.triangles.size());
}

TEST(CollapseEdges, KeepsEveryTunnel) {
    for (const char* name : {"torus-chain", "nested-shells", "gyroid"}) {
        SCOPED_TRACE(name);
        const Surface whole = extract(make_phantom(name, {.size = 64}), name == std::string("gyroid") ? 0 : 0.5);
        for (const std::size_t max : {2000, 200, 4}) expect_same_topology(whole, max);
    }
}

TEST(CollapseEdges, ReachesTheNumberWhereTunnelsAllowIt) {
    const Surface whole = extract(make_phantom("torus-chain", {.size = 48}), 0.5);
    ASSERT_GT(whole.triangles.size(), 10'000U);
    EXPECT_LE(collapse_edges(whole, 2000).triangles.size(), 2000U);
    EXPECT_EQ(collapse_edges(whole, whole.triangles.size()).triangles.size(), whole.triangles.size());
    EXPECT_TRUE(collapse_edges(Surface{}, 10).triangles.empty());
}

/// White noise with ties: nearly every cell is pierced.
TEST(CollapseEdges, KeepsTheTopologyOfNoise) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        Volume volume = make_volume({3, {7, 6, 5}}, ValueType::u8, {});
        for (std::uint8_t& sample : volume.samples<std::uint8_t>()) sample = static_cast<std::uint8_t>(random() % 4);
        for (const double tau : {0.5, 1.5, 2.0}) expect_same_topology(extract(volume, tau), 10);
    }
}

TEST(CollapseEdges, StaysCloseToTheSurface) {
    const Volume volume = make_phantom("torus-chain", {.size = 64});
    const Surface whole = extract(volume, 0.5);
    const Surface coarse = collapse_edges(whole, whole.triangles.size() / 8);
    const auto volume_of = [](const Surface& surface) {  // by the divergence theorem
        double sum = 0;
        for (const auto& [a, b, c] : surface.triangles) {
            const Vec3 &p = surface.points[a], &q = surface.points[b], &r = surface.points[c];
            sum += p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
        }
        return sum / 6;
    };
    EXPECT_NEAR(volume_of(coarse) / volume_of(whole), 1, 0.02);
}

/// Half of the triangles are not the same surface.
TEST(HasSameTopology, SeesAMissingComponent) {
    const Surface whole = extract(make_phantom("nested-shells", {.size = 64}), 0.5);
    Surface part = whole;
    part.triangles.resize(part.triangles.size() / 2);
    EXPECT_FALSE(has_same_topology(whole, part));
}

}  // namespace
}  // namespace isoatlas
