// Distances to and from the trilinear level set are what dense sampling finds.
#include "isoatlas/trilinear_distance.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "field/voxel_positions.h"
#include "methods/surfaces/level_set.h"
#include "methods/surfaces/point_distances.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::Extraction;
using isoatlas::SurfaceDistance;
using isoatlas::SurfaceMethod;
using isoatlas::Vec3;

constexpr double kPi = 3.14159265358979;

template <class Value>
isoatlas::Volume volume_of(Index size, Value value) {
    std::vector<double> values;
    for (Index v = 0; v < size * size * size; ++v)
        values.push_back(
            value(static_cast<double>(v % size), static_cast<double>(v / size % size), static_cast<double>(v / (size * size))));
    return isoatlas::make_volume<double>({3, {size, size, size}}, values);
}
/// Minus the distance from the middle.
isoatlas::Volume ball_of(Index size) {
    const double middle = static_cast<double>(size - 1) / 2;
    return volume_of(size, [=](double x, double y, double z) { return -std::hypot(x - middle, y - middle, z - middle); });
}
Extraction extraction(SurfaceMethod method, const isoatlas::Volume& volume, double tau, int divisions = 2) {
    return isoatlas::make_extractor(method, volume, {.divisions = divisions})->extract(tau);
}

TEST(TrilinearDistance, OfAPlaneIsNothing) {
    const isoatlas::Volume volume = volume_of(9, [](double x, double y, double z) { return x + 0.7 * y - 0.3 * z; });
    for (const isoatlas::SurfaceMethodInfo& info : isoatlas::surface_methods()) {
        if (isoatlas::makes_points(info.method) || info.method == SurfaceMethod::connected_contours) continue;
        const Extraction plane = extraction(info.method, volume, 4.123);
        EXPECT_LE(isoatlas::distance_to_trilinear(plane, volume, 4.123, {.error = 1e-5}).max, 1e-5) << info.name;
        EXPECT_LE(isoatlas::distance_from_trilinear(plane, volume, 4.123).max, 1e-9) << info.name;
    }
}

/// Level sets of a ball are a given distance apart. Those of the interpolant are almost spheres.
TEST(TrilinearDistance, OfSpheresIsTheDifferenceOfTheirRadii) {
    const isoatlas::Volume volume = ball_of(16);
    for (const double radius : {5.1, 5.4}) {
        const Extraction sphere = extraction(SurfaceMethod::trilinear, volume, -radius);
        for (const double other : {5.1}) {
            const double apart = std::abs(radius - other);
            const SurfaceDistance there = isoatlas::distance_to_trilinear(sphere, volume, -other);
            const SurfaceDistance back = isoatlas::distance_from_trilinear(sphere, volume, -other);
            EXPECT_NEAR(there.mean, apart, 0.02);
            EXPECT_NEAR(there.rms, apart, 0.03);
            EXPECT_NEAR(back.mean, apart, 0.02);
            EXPECT_NEAR(there.area / (4 * kPi * radius * radius), 1, 0.02);
            EXPECT_NEAR(back.area / (4 * kPi * other * other), 1, 0.05);  // an estimate from lines
            EXPECT_GE(there.max, there.rms);
            EXPECT_GE(there.rms, there.mean);
        }
    }
}

/// What is missing shows from the level set alone.
TEST(TrilinearDistance, OfHalfASphere) {
    const isoatlas::Volume volume = ball_of(24);
    Extraction half = extraction(SurfaceMethod::trilinear, volume, -9);
    isoatlas::Array<std::array<std::int64_t, 3>> kept;
    for (const auto& t : half.surface.triangles) {
        if (half.surface.points[t[0]][2] < 11.5) kept.push_back(t);
    }
    half.surface.triangles = kept;
    EXPECT_LT(isoatlas::distance_to_trilinear(half, volume, -9).max, 0.1);
    const SurfaceDistance back = isoatlas::distance_from_trilinear(half, volume, -9);
    EXPECT_EQ(back.max, 8);  // of the pole it is 9 / sqrt(2) or more; farther than the most that counts
    EXPECT_GT(back.mean, 1);
}

TEST(TrilinearDistance, OfNothingIsNothing) {
    const isoatlas::Volume volume = ball_of(8);
    const Extraction none = extraction(SurfaceMethod::trilinear, volume, 7), sphere = extraction(SurfaceMethod::trilinear, volume, -2.5);
    EXPECT_EQ(isoatlas::distance_to_trilinear(none, volume, 7).samples, 0);
    EXPECT_EQ(isoatlas::distance_from_trilinear(none, volume, 7).samples, 0);
    EXPECT_EQ(isoatlas::distance_to_trilinear(sphere, volume, 7).mean, 8);  // no level set at all
    EXPECT_EQ(isoatlas::distance_from_trilinear(none, volume, -2.5).mean, 8);
    EXPECT_THROW((void)isoatlas::distance_to_trilinear(sphere, volume, -2.5, {.error = 0}), isoatlas::Error);
    EXPECT_THROW((void)isoatlas::distance_from_trilinear(sphere, volume, std::nan("")), isoatlas::Error);
}

/// Half the diagonal of a small cube, but for the error.
TEST(TrilinearDistance, OfDividingCubesIsSmall) {
    const isoatlas::Volume volume = ball_of(12);
    for (const int divisions : {1, 2, 4}) {
        const Extraction cloud = extraction(SurfaceMethod::dividing_cubes, volume, -3.3, divisions);
        const SurfaceDistance there = isoatlas::distance_to_trilinear(cloud, volume, -3.3);
        EXPECT_LE(there.max, std::sqrt(3) / 2 / divisions * 1.011);
        EXPECT_EQ(there.samples, std::ssize(cloud.points.points));
        EXPECT_LE(isoatlas::distance_from_trilinear(cloud, volume, -3.3).max, std::sqrt(3) / divisions);
    }
}

/// Voxels, whatever the spacing and the axes.
TEST(TrilinearDistance, DoesNotDependOnTheGeometry) {
    isoatlas::Volume volume = ball_of(12);
    const SurfaceDistance plain = isoatlas::distance_to_trilinear(extraction(SurfaceMethod::marching_cubes, volume, -4.1), volume, -4.1);
    volume.info.geometry.spacing = {0.5, 2, 3}, volume.info.geometry.origin = {7, -5, 100};
    volume.info.geometry.direction = {{{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, -1}}};
    volume.info.geometry.coordinates[2] = {0, 1, 2, 4, 8, 9, 10, 12, 13, 14, 15, 20};
    const Extraction moved = extraction(SurfaceMethod::marching_cubes, volume, -4.1);
    for (const int threads : {1, 2, 3}) {
        const SurfaceDistance there = isoatlas::distance_to_trilinear(moved, volume, -4.1, {}, {.threads = threads});
        EXPECT_NEAR(there.mean, plain.mean, 1e-6);
        EXPECT_NEAR(there.max, plain.max, 1e-6);
        EXPECT_NEAR(there.area, plain.area, 1e-6);
    }
}

double arbitrary_part() { return *rc::gen::inRange(0, 10'001) / 10'000.0; }

/// Crossings on the edges of cells divided 16 times along each axis: the level set has no point farther than the diagonal of such a cube
/// from one of them.
RC_GTEST_PROP(TrilinearDistanceOf, AnyPointIsThatOfDenseSampling, ()) {
    Grid grid = *arbitrary_grid(4, 30);
    grid.rank = 3;
    const std::vector<double> values = interesting_values(elements_of(grid, isoatlas::Interpolant::trilinear));
    const double tau = values[*rc::gen::inRange<std::size_t>(0, values.size())];
    const isoatlas::LevelSet<double> level_set({3, {grid.size}}, grid.value, tau);
    Vec3 point;
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = arbitrary_part() * static_cast<double>(grid.size[axis] - 1);
    double sampled = 20;
    constexpr int kTimes = 16;
    const auto cells = level_set.cells();
    for (Index z = 0; z < cells[2]; ++z) {
        for (Index y = 0; y < cells[1]; ++y) {
            for (Index x = 0; x < cells[0]; ++x) {
                const isoatlas::LevelBox cell = level_set.box({x, y, z});
                for (int line = 0; line < 3 * (kTimes + 1) * (kTimes + 1); ++line) {
                    const auto axis = static_cast<std::size_t>(line % 3);
                    Vec3 part{};
                    part[(axis + 1) % 3] = line / 3 % (kTimes + 1) / static_cast<double>(kTimes);
                    part[(axis + 2) % 3] = line / 3 / (kTimes + 1) / static_cast<double>(kTimes);
                    const double first = cell.value_at(part);
                    part[axis] = 1;
                    const double last = cell.value_at(part);
                    if (!(std::min(first, last) <= 0 && std::max(first, last) >= 0)) continue;
                    part[axis] = first == last ? std::clamp(point[axis] - cell.from[axis], 0.0, 1.0) : first / (first - last);
                    sampled = std::min(sampled, isoatlas::distance_between(
                                                    point, {cell.from[0] + part[0], cell.from[1] + part[1], cell.from[2] + part[2]}));
                }
            }
        }
    }
    const double found = level_set.distance(point, 0.001, 20);
    RC_ASSERT(found <= sampled + std::max(0.001, 0.011 * sampled));
    RC_ASSERT(found >= sampled - std::sqrt(3) / kTimes || sampled == 20);
}

RC_GTEST_PROP(TrilinearDistanceOf, AnyTrianglesIsThatOfTheNearest, ()) {
    const auto arbitrary_point = [] { return Vec3{4 * arbitrary_part(), 3 * arbitrary_part(), 5 * arbitrary_part()}; };
    std::vector<isoatlas::Corners3> triangles;
    for (int i = *rc::gen::inRange(1, 6); i > 0; --i) triangles.push_back({arbitrary_point(), arbitrary_point(), arbitrary_point()});
    if (*rc::gen::inRange(0, 3) == 0) triangles[0][2] = triangles[0][1];
    const Vec3 point = arbitrary_point();
    double nearest = 20, sampled = 20;
    constexpr int kTimes = 40;
    for (const auto& t : triangles) {
        nearest = std::min(nearest, isoatlas::distance_to_triangle(point, t));
        for (int i = 0; i <= kTimes; ++i) {
            for (int j = 0; i + j <= kTimes; ++j) {
                Vec3 at;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    at[axis] = t[0][axis] + i * (t[1][axis] - t[0][axis]) / kTimes + j * (t[2][axis] - t[0][axis]) / kTimes;
                sampled = std::min(sampled, isoatlas::distance_between(point, at));
            }
        }
    }
    RC_ASSERT(nearest <= sampled + 1e-9);
    RC_ASSERT(nearest >= sampled - 8.0 / kTimes);  // the longest edge has a length of at most sqrt(50)
}

// Few points and many, so that slices are looked at whole and by rows.
RC_GTEST_PROP(TrilinearDistanceOf, PointsIsThatOfTheNearestTriangle, ()) {
    const auto arbitrary_point = [] { return Vec3{9 * arbitrary_part(), 7 * arbitrary_part(), 3 * arbitrary_part()}; };
    std::vector<isoatlas::Corners3> triangles;
    for (int i = *rc::gen::inRange(0, 6); i > 0; --i) triangles.push_back({arbitrary_point(), arbitrary_point(), arbitrary_point()});
    std::vector<Vec3> points;
    for (int i = *rc::gen::element(1, 5, 400); i > 0; --i) points.push_back(arbitrary_point());
    const double max = *rc::gen::element(0.5, 2.0, 20.0);
    isoatlas::PointDistances distances(points, max);
    for (const auto& t : triangles) distances.add(t);
    for (std::size_t i = 0; i < points.size(); ++i) {
        double nearest = max;
        for (const auto& t : triangles) nearest = std::min(nearest, isoatlas::distance_to_triangle(points[i], t));
        RC_ASSERT(distances[i] == nearest);
    }
}

RC_GTEST_PROP(VoxelPositions, AreTheInverseOfToPhysical, ()) {
    Grid grid = *arbitrary_grid(5, 60);
    grid.rank = 3;
    const isoatlas::Geometry geometry = arbitrary_geometry(grid);
    Vec3 point;
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = arbitrary_part() * static_cast<double>(grid.size[axis] - 1);
    const Vec3 back = isoatlas::VoxelPositions(geometry).of(isoatlas::to_physical(geometry, point));
    for (std::size_t axis = 0; axis < 3; ++axis) RC_ASSERT(std::abs(back[axis] - point[axis]) < 1e-9);
}

}  // namespace
}  // namespace oracle
