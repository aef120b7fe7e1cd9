// Points spread over a surface: on it, with its normals, as many in a part of it as the part has area.
#include "preview/sample_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/triangles.h"
#include "geometry/vectors.h"
#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

double distance_from(const Surface& surface, const Vec3& point) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : surface.triangles)
        least = std::min(least, squared_distance(point, surface.points[a], surface.points[b], surface.points[c]));
    return std::sqrt(least);
}

TEST(SurfaceSample, LiesOnTheSurface) {
    const Surface surface = extract(make_phantom("torus-chain", {.size = 24}), 0.5);
    const SurfaceSample sample = sample_surface(surface, 500);
    ASSERT_EQ(sample.cloud.points.size(), 500U);
    ASSERT_EQ(sample.cloud.normals.size(), 500U);
    for (std::size_t i = 0; i < 500; ++i) {
        EXPECT_LT(distance_from(surface, sample.cloud.points[i]), 1e-9);
        const auto& [x, y, z] = sample.cloud.normals[i];
        EXPECT_NEAR(std::hypot(x, y, z), 1, 1e-6);
    }
}

/// A wide triangle and a narrow one, three times the area.
TEST(SurfaceSample, HasAsManyPointsInAPartAsItHasArea) {
    Surface surface;
    for (const Vec3& point : {Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{0, 2, 0}, Vec3{0, 0, 5}, Vec3{1, 0, 5}, Vec3{0, 2, 5}})
        surface.points.push_back(point), surface.normals.push_back({0, 0, 1});
    surface.triangles.push_back({0, 1, 2});
    surface.triangles.push_back({3, 4, 5});
    const SurfaceSample sample = sample_surface(surface, 400);
    EXPECT_DOUBLE_EQ(sample.spacing, 0.1);
    EXPECT_EQ(std::ranges::count(sample.cloud.points, 0.0, [](const Vec3& p) { return p[2]; }), 300);
    Vec3 mean{};
    for (std::size_t i = 0; i < 300; ++i) mean = plus(mean, sample.cloud.points[i]);
    EXPECT_NEAR(mean[0] / 300, 1, 0.02);  // the triangle's centre
    EXPECT_NEAR(mean[1] / 300, 2.0 / 3, 0.02);
}

TEST(SurfaceSample, IsTheSameForAnyNumberOfThreads) {
    const Surface surface = extract(make_phantom("noise", {.size = 24}), 0.5);
    ASSERT_GT(surface.triangles.size(), 3U * 4096);  // several pieces
    Context one, three;
    one.threads = 1, three.threads = 3;
    for (const std::int64_t points : {1, 7, 5000, 200'000}) {
        const SurfaceSample first = sample_surface(surface, points, one), second = sample_surface(surface, points, three);
        EXPECT_NEAR(static_cast<double>(first.cloud.points.size()), static_cast<double>(points), 1);
        EXPECT_EQ(first.cloud.points, second.cloud.points);
        EXPECT_EQ(first.cloud.normals, second.cloud.normals);
        for (const auto& [x, y, z] : first.cloud.normals) ASSERT_NEAR(std::hypot(x, y, z), 1, 1e-6);  // each was set
    }
}

TEST(SurfaceSample, OfNothingIsEmpty) {
    EXPECT_TRUE(sample_surface(Surface{}, 10).cloud.points.empty());
    const Surface surface = extract(make_phantom("torus-chain", {.size = 24}), 0.5);
    EXPECT_TRUE(sample_surface(surface, 0).cloud.points.empty());
}

}  // namespace
}  // namespace isoatlas
