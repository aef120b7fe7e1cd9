#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "isoatlas/cut.h"
#include "isoatlas/surface.h"

namespace isoatlas {
namespace {

template <class T, class Function>
Volume field(Index3 size, Function&& value, int rank = 3) {
    Extent extent;
    extent.rank = rank;
    extent.size = size;
    Volume volume = make_volume(extent, value_type_of<T>);
    auto samples = volume.samples<T>();
    for (std::int64_t i = 0; i < extent.voxels(); ++i) {
        const auto p = extent.voxel(i);
        samples[i] = static_cast<T>(value(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])));
    }
    return volume;
}

/// A ball of Highs (100) with a hollow (0) in the middle, and a speck.
Volume hollow_ball() {
    return field<std::uint8_t>({12, 12, 12}, [](double x, double y, double z) {
        const double r = std::hypot(x - 5, y - 5, z - 5);
        return r < 4 && r > 1.5 ? 100 : x == 11 && y == 11 && z == 11 ? 50 : 0;
    });
}

template <class Call>
Error error_of(Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        return error;
    }
    return {ErrorKind::internal, {.what = "nothing was thrown"}};
}

// On a linear field hits are exact and every normal is the (negative) gradient, also on skewed and mirrored axes.
TEST(Extract, PointsAndNormalsOfALinearField) {
    const std::array<Mat3, 3> directions{
        {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {{{0, -0.6, 0.8}, {0, 0.8, 0.6}, {-1, 0, 0}}}, {{{1, 0.6, 0}, {0, 0.8, 0}, {0, 0, -1}}}}};
    for (const Mat3& direction : directions) {
        for (const bool rectilinear : {false, true}) {
            Geometry geometry;
            geometry.spacing = {0.5, 2, 1};
            geometry.origin = {10, -20, 30};
            geometry.direction = direction;
            if (rectilinear) geometry.coordinates = {{{1, 2, 4, 7, 8, 10}, {0, 1, 3, 4, 6}, {-5, -4, -2, 3}}};
            const Vec3 slope{0.3, -0.7, 0.45};  // in physical space
            Volume volume = field<double>({6, 5, 4}, [](double, double, double) { return 0; });
            volume.info.geometry = geometry;
            const Extent& extent = volume.info.extent;
            const auto value_at = [&](const Vec3& p) { return slope[0] * p[0] + slope[1] * p[1] + slope[2] * p[2]; };
            for (std::int64_t i = 0; i < extent.voxels(); ++i) {
                const auto p = extent.voxel(i);
                volume.samples<double>()[i] =
                    value_at(to_physical(geometry, {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])}));
            }
            const double tau = volume.value(extent.index(3, 2, 1)) + 0.01;
            SurfaceOptions options;
            options.boundary = Boundary::open;
            for (const SurfaceStyle style : {SurfaceStyle::compact, SurfaceStyle::full}) {
                options.style = style;
                const Surface surface = extract(volume, tau, {.surface = options});
                ASSERT_GT(surface.points.size(), 10U);
                const double length = std::hypot(slope[0], slope[1], slope[2]);
                for (std::size_t i = 0; i < surface.points.size(); ++i) {
                    EXPECT_NEAR(value_at(surface.points[i]), tau, 0.01);  // exact but for hits at the margin of an edge
                    for (int a = 0; a < 3; ++a) EXPECT_NEAR(surface.normals[i][a], -slope[a] / length, 1e-5);
                }
                for (const auto& t : surface.triangles) {  // the triangles face the same way
                    Vec3 u{}, v{};
                    for (int a = 0; a < 3; ++a) {
                        u[a] = surface.points[t[1]][a] - surface.points[t[0]][a];
                        v[a] = surface.points[t[2]][a] - surface.points[t[0]][a];
                    }
                    const Vec3 n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
                    EXPECT_LT(n[0] * slope[0] + n[1] * slope[1] + n[2] * slope[2], 0);
                }
            }
        }
    }
}

TEST(Extract, CapsLieJustOutsideTheVolumeAndFaceOutwards) {
    Volume volume = field<std::int16_t>({1, 1, 1}, [](double, double, double) { return -5; });
    volume.info.geometry.spacing = {2, 1, 1};
    const Surface surface = extract(volume, -7);
    ASSERT_EQ(surface.points.size(), 6U);
    EXPECT_EQ(surface.triangles.size(), 8U);
    for (std::size_t i = 0; i < 6; ++i) {
        double distance = 0;
        for (int a = 0; a < 3; ++a) {
            distance += std::abs(surface.points[i][a]) / volume.info.geometry.spacing[a];
            EXPECT_EQ(surface.normals[i][a], surface.points[i][a] == 0 ? 0 : surface.points[i][a] > 0 ? 1 : -1);
        }
        EXPECT_EQ(distance, 1.0 / 1024);
    }
}

TEST(Extract, NothingAboveTheMaximumTheBoxBelowTheMinimum) {
    const Volume volume = hollow_ball();
    for (const double tau : {100.5, 256.0, 1e300}) {
        const Surface surface = extract(volume, tau);
        EXPECT_TRUE(surface.points.empty() && surface.triangles.empty());
    }
    for (const double tau : {0.0, -3.0, -1e300}) {
        const Surface box = extract(volume, tau);
        const SurfaceReport report = inspect(box.points, box.triangles);
        EXPECT_EQ(report.component_chi, (std::vector<std::int64_t>{2}));
        EXPECT_TRUE(report.is_closed() && report.has_no_zero_area());
    }
}

TEST(Extract, ObjectsContoursShells) {
    const Volume volume = hollow_ball();
    const Extent& extent = volume.info.extent;
    const Cut cut = isoatlas::cut(volume, 30);
    ASSERT_EQ(cut.objects.size(), 2U);
    ASSERT_EQ(cut.contours.size(), 3U);
    const auto shells = [&](SurfaceOptions options) {
        const Surface surface = extract(volume, 30, {.surface = options});
        return inspect(surface.points, surface.triangles).component_chi.size();
    };
    SurfaceOptions options;
    EXPECT_EQ(shells(options), 3U);
    options.objects = {extent.index(5, 5, 8)};
    EXPECT_EQ(shells(options), 2U);
    options.shell = ShellChoice::inner;
    EXPECT_EQ(shells(options), 1U);
    options.objects = {extent.index(11, 11, 11)};
    EXPECT_EQ(shells(options), 0U);
    options.objects = {extent.index(11, 11, 11), extent.index(5, 5, 8)};
    options.shell = ShellChoice::outer;
    EXPECT_EQ(shells(options), 2U);
    options = {};
    options.contours = {cut.contours[1].id};
    EXPECT_EQ(cut.contours[1].shell, Shell::inner);
    EXPECT_EQ(shells(options), 1U);
    options.shell = ShellChoice::outer;  // a cavity is no outer shell
    EXPECT_EQ(shells(options), 0U);
}

TEST(Extract, WhatIsNotAskedForIsNotThere) {
    SurfaceOptions options;
    options.normals = false;
    options.ids = false;
    const Surface surface = extract(hollow_ball(), 30, {.surface = options});
    EXPECT_FALSE(surface.points.empty());
    EXPECT_TRUE(surface.normals.empty() && surface.object.empty() && surface.contour.empty() && surface.segments.empty());
}

TEST(Extract, CarriesWhatTheSurfaceMeans) {
    Volume volume = hollow_ball();
    volume.info.geometry.space = "LPS";
    volume.info.geometry.unit = "mm";
    volume.info.calibration = {2, -10};
    SurfaceOptions options;
    options.boundary = Boundary::open;
    const Surface surface = extract(volume, 30, {.surface = options});
    EXPECT_EQ(surface.tau, 30);
    EXPECT_EQ(surface.reported_tau, 50);
    EXPECT_EQ(surface.space, "LPS");
    EXPECT_EQ(surface.unit, "mm");
    EXPECT_FALSE(surface.closed);
    EXPECT_TRUE(extract(volume, 30).closed);
}

TEST(Extract, SaysWhyThereIsNoSuchObject) {
    Volume volume = hollow_ball();
    SurfaceOptions options;
    options.objects = {volume.info.extent.index(5, 5, 5)};
    Error error = error_of([&] { static_cast<void>(extract(volume, 30, {.surface = options})); });
    EXPECT_EQ(error.kind(), ErrorKind::not_found);
    EXPECT_EQ(error.text().where, "voxel 785 (5, 5, 5)");
    EXPECT_EQ(error.text().what, "its value 0 is below the isovalue 30, so no object contains it");
    for (const std::int64_t voxel : {std::int64_t{-1}, volume.info.extent.voxels()}) {
        options.objects = {voxel};
        error = error_of([&] { static_cast<void>(extract(volume, 30, {.surface = options})); });
        EXPECT_EQ(error.kind(), ErrorKind::not_found);
        EXPECT_EQ(error.text().expected, "a voxel index from 0 to 1727");
    }
    options.objects.clear();
    options.contours = {785, 786};
    error = error_of([&] { static_cast<void>(extract(volume, 30, {.surface = options})); });
    EXPECT_EQ(error.kind(), ErrorKind::not_found);
    for (const double tau : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_EQ(error_of([&] { static_cast<void>(extract(volume, tau)); }).kind(), ErrorKind::usage);
    }
    volume.info.geometry.direction = {{{1, 1, 0}, {0, 0, 0}, {0, 0, 1}}};
    EXPECT_EQ(error_of([&] { static_cast<void>(extract(volume, 30)); }).kind(), ErrorKind::usage);
}

TEST(Extract, HugeAndTinyValues) {
    for (const double scale : {1e308, 1e200, 1e-200, 5e-324}) {
        const Volume volume = field<double>(
            {4, 4, 4}, [&](double x, double y, double z) { return scale * (std::fmod(x * 3 + y * 5 + z * 7, 4) > 1 ? 1 : -1); });
        const Surface surface = extract(volume, 0);
        ASSERT_FALSE(surface.points.empty());
        for (std::size_t i = 0; i < surface.points.size(); ++i) {
            for (const double coordinate : surface.points[i]) EXPECT_TRUE(std::isfinite(coordinate));
            EXPECT_NEAR(std::hypot(surface.normals[i][0], surface.normals[i][1], surface.normals[i][2]), 1, 1e-5) << scale;
        }
    }
}

TEST(Extract, ReportsProgressFromTheCallingThreadAndStopsWhenAsked) {
    const Volume volume = hollow_ball();
    Context context;
    context.threads = 3;
    context.slab_slices = 1;
    int calls = 0;
    const std::thread::id caller = std::this_thread::get_id();
    context.progress = [&](const Progress& p) {
        ++calls;
        EXPECT_EQ(std::this_thread::get_id(), caller);
        EXPECT_GE(p.fraction, 0);
        EXPECT_LE(p.fraction, 1);
        EXPECT_LT(p.phase_index, p.phase_count);
    };
    static_cast<void>(extract(volume, 30, {}, context));
    EXPECT_GT(calls, 3);
    int polls = 0;
    context.cancelled = [&] { return ++polls > 5; };
    EXPECT_EQ(error_of([&] { static_cast<void>(extract(volume, 30, {}, context)); }).kind(), ErrorKind::cancelled);
    polls = 0;
    EXPECT_EQ(error_of([&] { static_cast<void>(cut(volume, 30, {}, context)); }).kind(), ErrorKind::cancelled);
}

}  // namespace
}  // namespace isoatlas
