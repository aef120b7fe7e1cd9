// Walls of plates, shells, tubes and boxes are as thick as they are, to half a voxel, on grids of every kind.
#include "isoatlas/thickness.h"

#include <gtest/gtest.h>

#include <numbers>

#include "isoatlas/error.h"
#include "unit/measures/shape.h"

namespace isoatlas::shapes {
namespace {

constexpr double kStep = 0.1;
constexpr double kHalfVoxel = 0.0625;  // of the longest step of the grids

class Walls : public testing::TestWithParam<GridKind> {};
INSTANTIATE_TEST_SUITE_P(Grids, Walls, testing::ValuesIn(grid_kinds()), [](const auto& grid) { return grid.param.name; });

WallThickness thickness_of(const Field& field, const GridKind& kind, double reach, double limit = 0, ShellChoice shell = ShellChoice::all) {
    const Volume volume = sample(field, kind, kStep, reach);
    return wall_thickness(extract(volume, 0, {.surface = {.objects = {}, .contours = {}, .shell = shell}}), {.limit = limit});
}

/// A disk of a plate across a direction.
Field plate(double thickness, const Vec3& across) {
    return [=, n = unit(across)](const Vec3& p) {
        const double along = dot(p, n);
        return std::min(thickness / 2 - std::abs(along), 1 - norm(minus(p, times(along, n))));
    };
}

TEST_P(Walls, Plates) {
    for (const Vec3& across : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{1, 2, 3}, Vec3{-2, 1, 0.3}}) {
        for (const double thickness : {0.21, 0.3, 0.55}) {
            const WallThickness walls = thickness_of(plate(thickness, across), GetParam(), 1, thickness + 2 * kHalfVoxel);
            EXPECT_NEAR(walls.min, thickness, kHalfVoxel) << across[0];
            EXPECT_NEAR(walls.median, thickness, kHalfVoxel / 2) << across[0];
            EXPECT_GT(walls.area, 0.8 * 2 * std::numbers::pi);
            EXPECT_GT(walls.thin_area, 0.85 * 2 * std::numbers::pi);
        }
    }
}

TEST_P(Walls, ShellsWithTheirCavity) {
    const WallThickness walls = thickness_of(shell(0.7, 1), GetParam(), 1, 0.1);
    EXPECT_NEAR(walls.min, 0.3, kHalfVoxel);
    EXPECT_NEAR(walls.median, 0.3, kHalfVoxel / 2);
    EXPECT_NEAR(walls.area, 4 * std::numbers::pi * (1 + 0.49), 0.5);
    EXPECT_EQ(walls.thin_area, 0);
    // For printing the cavity is filled.
    EXPECT_NEAR(thickness_of(shell(0.7, 1), GetParam(), 1, 0, ShellChoice::outer).min, 2, kHalfVoxel);
}

TEST_P(Walls, BallsAndTorusesAreTheirDiameters) {
    const WallThickness whole = thickness_of(ball(1), GetParam(), 1);
    EXPECT_NEAR(whole.min, 2, 2 * kHalfVoxel);
    EXPECT_NEAR(whole.median, 2, kHalfVoxel);
    const WallThickness ring = thickness_of(torus(1, 0.35), GetParam(), 1.4);
    EXPECT_NEAR(ring.min, 0.7, kHalfVoxel);
    EXPECT_NEAR(ring.median, 0.7, kHalfVoxel);
}

TEST_P(Walls, OfABoxAreNotItsEdges) {
    const WallThickness walls = thickness_of(box({1, 0.7, 0.2}), GetParam(), 1);
    EXPECT_NEAR(walls.min, 0.4, kHalfVoxel);
    EXPECT_NEAR(walls.median, 0.4, kHalfVoxel);
}

// A wall in the middle of something thick: the median is that of most of the surface.
TEST_P(Walls, ThinOnesAreFound) {
    const Field neck = [](const Vec3& p) {
        const double ends = std::max(0.6 - norm(minus(p, {0.9, 0, 0})), 0.6 - norm(minus(p, {-0.9, 0, 0})));
        return std::max(ends, std::min(0.15 - std::hypot(p[1], p[2]), 0.9 - std::abs(p[0])));
    };
    const WallThickness walls = thickness_of(neck, GetParam(), 1.5, 0.5);
    EXPECT_NEAR(walls.min, 0.3, kHalfVoxel);
    EXPECT_GT(walls.median, 1);
    EXPECT_GT(walls.thin_area, 0.01 * walls.area);
    EXPECT_LT(walls.thin_area, 0.1 * walls.area);
}

// Each object has its own, also of low values.
TEST_P(Walls, OfEachObject) {
    const Field two = [](const Vec3& p) { return std::max(ball(0.6)(minus(p, {0.8, 0, 0})), shell(0.3, 0.55)(minus(p, {-0.8, 0, 0}))); };
    for (const bool is_low : {false, true}) {
        Volume volume = sample([&](const Vec3& p) { return is_low ? -two(p) : two(p); }, GetParam(), kStep, 1.5);
        if (is_low) volume = negated(std::move(volume));
        const std::vector<ObjectMeasures> objects = measure_objects(volume, 0, {.thickness = true});
        ASSERT_EQ(objects.size(), 2U);
        const bool ball_first = objects[0].cavities == 0;
        EXPECT_NEAR(objects[ball_first ? 0 : 1].thickness.median, 1.2, kHalfVoxel);
        EXPECT_NEAR(objects[ball_first ? 1 : 0].thickness.median, 0.25, kHalfVoxel);
        EXPECT_NEAR(objects[ball_first ? 1 : 0].thickness.min, 0.25, kHalfVoxel);
        EXPECT_TRUE(std::isnan(measure_objects(volume, 0)[0].thickness.median));
    }
}

TEST(WallsOfAWedge, GrowFromItsEdge) {
    const Field wedge = [](const Vec3& p) { return std::min({p[2] + 0.5, 0.4 * (0.7 - p[0]) - p[2] - 0.5, 1 - std::abs(p[1])}); };
    EXPECT_LT(thickness_of(wedge, grid_kinds()[0], 1).min, 2 * kStep);
}

TEST(WallsOfSurfaces, TheSameForAnyThreads) {
    const Surface surface = extract(sample(shell(0.7, 1), grid_kinds()[1], kStep, 1), 0);
    Context one, more;
    one.threads = 1, more.threads = 3;
    const WallThickness first = wall_thickness(surface, {.limit = 0.3}, one), second = wall_thickness(surface, {.limit = 0.3}, more);
    EXPECT_EQ(first.min, second.min);
    EXPECT_EQ(first.median, second.median);
    EXPECT_EQ(first.thin_area, second.thin_area);
}

TEST(WallsOfSurfaces, Refusals) {
    Surface surface = extract(sample(ball(1), grid_kinds()[0], 0.2, 1), 0);
    surface.closed = false;
    EXPECT_THROW((void)wall_thickness(surface), Error);
    EXPECT_EQ(wall_thickness({}).triangles, 0);
}

}  // namespace
}  // namespace isoatlas::shapes
