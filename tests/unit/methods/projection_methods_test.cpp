// Methods in image order and in object order against integrals that are known, with the errors that their papers leave them.
#include "isoatlas/projection_methods.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace isoatlas {
namespace {

using Field = std::function<double(const Vec3&)>;  // of a place in samples

Volume sampled(std::int64_t size, const Field& field, const Geometry& geometry = {}) {
    Volume volume = make_volume({.rank = 3, .size = {size, size, size}}, ValueType::f32, geometry);
    for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i) {
        const auto at = volume.info.extent.voxel(i);
        volume.samples<float>()[i] =
            static_cast<float>(field({static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])}));
    }
    return volume;
}

/// White matter whose extinction is `density` at a value of 1 and proportional to it.
SceneVolume proportional(const Volume& volume, double density) {
    SceneVolume matter{.volume = &volume, .range = std::array<double, 2>{0, 1}};
    matter.curves = {{.points = {{0, 0}, {1, density}}, .colour = {1, 1, 1}}};
    return matter;
}

/// From `around` degrees to the right of the front and `above`, on the middle of a volume with `size` samples along each axis.
Camera camera_from(std::int64_t size, double around, double above, double height, double spacing = 1) {
    const double middle = spacing * static_cast<double>(size - 1) / 2;
    return {.target = {middle, middle, middle}, .view = view_from(around, above), .height = height};
}

double opacity_in_the_middle(const ProjectedPicture& picture) {
    return static_cast<double>(picture.pixels[picture.width / 2 + picture.width * (picture.height / 2)][3]);
}

TEST(ProjectionMethods, AreListedInTheirOrder) {
    ASSERT_EQ(projection_methods().size(), 3U);
    for (const ProjectionMethodInfo& info : projection_methods()) EXPECT_EQ(&info_of(info.method), &info);
}

TEST(ProjectionMethods, ASlabAbsorbsAsBeerAndLambertSay) {
    // Ten slices of 1 in a volume of 0, perpendicular to y: with the ramps at both ends the interpolant has a thickness of 10.
    constexpr std::int64_t kSize = 40;
    const Volume volume = sampled(kSize, [](const Vec3& p) { return p[1] > 14.5 && p[1] < 24.5 ? 1.0 : 0.0; });
    const SceneVolume matter = proportional(volume, 0.1);
    const ProjectionOptions options{.width = 7, .height = 7, .step = 0.25, .kernel = 0.8};
    for (const double around : {0.0, 20.0, 180.0, 44.0}) {
        const Camera camera = camera_from(kSize, around, 0, 3);
        const double exact = 1 - std::exp(-0.1 * 10 / std::abs(std::cos(around * M_PI / 180)));
        for (const ProjectionMethodInfo& info : projection_methods()) {
            const ProjectedPicture picture = project_by(info.method, matter, camera, options);
            // Shear-warp adds up the slices exactly. The kernels of splatting add up to 1 but for 2 exp(-2 pi^2 kernel^2) along each axis,
            // here 1e-5, and the part of them that is cut off, exp(-6), for which the rest makes up.
            const double tolerance = 0.0005;
            EXPECT_NEAR(opacity_in_the_middle(picture), exact, tolerance) << info.name << ' ' << around;
            for (std::size_t c = 0; c < 3; ++c)  // white emission saturates to the opacity
                EXPECT_NEAR(picture.pixels[24][c], picture.pixels[24][3], 1e-5) << info.name;
            EXPECT_GT(picture.samples, 0) << info.name;
        }
    }
}

TEST(ProjectionMethods, RaysAreExactInConstantMatterAtAnyStep) {
    const Volume volume = sampled(11, [](const Vec3&) { return 1.0; });
    for (const double step : {0.3, 1.0, 3.7, 16.0}) {
        const ProjectedPicture picture = project_by(ProjectionMethod::ray_casting, proportional(volume, 0.1), camera_from(11, 0, 0, 3),
                                                    {.width = 3, .height = 3, .step = step});
        EXPECT_NEAR(opacity_in_the_middle(picture), 1 - std::exp(-0.1 * 10), 1e-4) << step;
    }
}

TEST(ProjectionMethods, ABallIsAsDenseAsItsChord) {
    // Density 1 - (r / 16)^2, on a grid with turned axes and unequal spacing. Its integral at distance d is 4 / 3 (256 - d^2)^1.5 / 256.
    Geometry geometry;
    geometry.spacing = {0.5, 0.8, 0.5};
    geometry.direction = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
    constexpr std::int64_t kSize = 69;
    const auto density = [](const Vec3& p) {
        return std::max(0.0, 1 - std::pow(std::hypot(0.5 * (p[0] - 34), 0.8 * (p[1] - 34), 0.5 * (p[2] - 34)) / 16, 2));
    };
    const Volume volume = sampled(kSize, density, geometry);
    const SceneVolume matter = proportional(volume, 0.05);
    const ProjectionOptions options{.width = 72, .height = 72, .step = 0.5};
    const Camera camera{.target = {-0.8 * 34, 17, 17}, .view = view_from(25, 15), .height = 36};
    for (const ProjectionMethodInfo& info : projection_methods()) {
        const ProjectedPicture picture = project_by(info.method, matter, camera, options);
        double worst = 0;
        for (std::int64_t y = 0; y < 72; ++y) {
            for (std::int64_t x = 0; x < 72; ++x) {
                const double d2 = (std::pow(static_cast<double>(x) - 35.5, 2) + std::pow(static_cast<double>(y) - 35.5, 2)) / 4;
                const double depth = d2 < 256 ? 0.05 * 4 / 3 * std::pow(256 - d2, 1.5) / 256 : 0;
                worst = std::max(worst, std::abs(static_cast<double>(picture.pixels[x + 72 * y][3]) - (1 - std::exp(-depth))));
            }
        }
        EXPECT_LT(worst, 0.009) << info.name;
    }
}

TEST(ProjectionMethods, FinerStepsOfRaysComeCloserToTheIntegral) {
    constexpr std::int64_t kSize = 32;
    const Volume volume = sampled(kSize, [](const Vec3& p) { return 0.5 + 0.5 * std::sin(p[0]) * std::sin(1.3 * p[1]) * std::cos(p[2]); });
    SceneVolume matter{.volume = &volume, .tents = {{.low = 0.5, .high = 0.8, .colour = {1, 0.5, 0}, .density = 0.3}}};
    const Camera camera = camera_from(kSize, 33, 21, 40);
    const ProjectionOptions options{.width = 24, .height = 24};
    const ProjectedPicture exact = projected_integral(matter, camera, options);
    double last = 1;
    for (const double step : {4.0, 1.0, 0.25, 0.0625}) {
        ProjectionOptions coarse = options;
        coarse.step = step;
        const ProjectedPicture picture = project_by(ProjectionMethod::ray_casting, matter, camera, coarse);
        const PictureError error = picture_error(picture, exact);
        EXPECT_LT(error.root_mean_square, 0.2 * last) << step;  // the square of the step: 1 / 16, but for the corners of the tent
        EXPECT_LE(error.root_mean_square, error.largest);
        last = error.root_mean_square;
    }
    EXPECT_LT(last, 1e-4);
}

TEST(ProjectionMethods, TheNearerColourIsSeenFromBothSides) {
    constexpr std::int64_t kSize = 24;
    const Volume volume = sampled(kSize, [](const Vec3& p) { return p[1] < 5 ? 0.5 : p[1] < 10 ? 0.0 : p[1] < 15 ? 1.0 : 0.5; });
    SceneVolume matter{.volume = &volume, .range = std::array<double, 2>{0, 1}};
    matter.tents = {{.low = -0.1, .high = 0.1, .colour = {1, 0, 0}, .density = 3, .ramp = 0},
                    {.low = 0.9, .high = 1.1, .colour = {0, 0, 1}, .density = 3, .ramp = 0}};
    for (const ProjectionMethodInfo& info : projection_methods()) {
        const auto middle = [&](double around) {
            return project_by(info.method, matter, camera_from(kSize, around, 0, 4), {.width = 5, .height = 5, .step = 0.1}).pixels[12];
        };
        EXPECT_GT(middle(0)[0], 0.9) << info.name;  // y is low in front
        EXPECT_GT(middle(180)[2], 0.9) << info.name;
    }
}

TEST(Splatting, AFootprintHasTheShapeOfItsCell) {
    // One sample in a grid of long cells. The covariance of its footprint is that of the kernel, a ball in samples, projected.
    Geometry geometry;
    geometry.spacing = {1, 3, 1};
    const Volume volume = sampled(9, [](const Vec3& p) { return p == Vec3{4, 4, 4} ? 1.0 : 0.0; }, geometry);
    const Camera camera{.target = {4, 12, 4}, .view = view_from(30, 40), .height = 20};
    const ProjectionOptions options{.width = 100, .height = 100, .kernel = 0.7};
    SceneVolume matter{.volume = &volume};
    matter.curves = {{.points = {{0.5, 1e-3}, {1, 1e-3}}, .colour = {1, 1, 1}}};
    const ProjectedPicture picture = project_by(ProjectionMethod::splatting, matter, camera, options);
    EXPECT_EQ(picture.samples, 1);
    const auto place = [&](const Vec3& at) { return project(camera, {.width = 100, .height = 100}, at); };
    double sum = 0, uu = 0, uv = 0, vv = 0;
    for (std::int64_t i = 0; i < 100 * 100; ++i) {
        const double u = static_cast<double>(i % 100) - 49.5, v = static_cast<double>(i / 100) - 49.5;
        const auto opacity = static_cast<double>(picture.pixels[i][3]);
        sum += opacity, uu += u * u * opacity, uv += u * v * opacity, vv += v * v * opacity;
    }
    Vec3 exact{};  // of u u, u v, v v
    for (int a = 0; a < 3; ++a) {
        Vec3 end{4, 12, 4};
        end[a] += geometry.spacing[a];
        const Vec3 way = place(end);
        const double u = 0.7 * (way[0] - 50), v = 0.7 * (way[1] - 50);
        exact[0] += u * u, exact[1] += u * v, exact[2] += v * v;
    }
    ASSERT_GT(std::abs(exact[1]), 0.1 * exact[0]);
    EXPECT_NEAR(uu / sum, exact[0], 0.03 * exact[0]);  // less the part that is cut off
    EXPECT_NEAR(uv / sum, exact[1], 0.03 * std::abs(exact[1]));
    EXPECT_NEAR(vv / sum, exact[2], 0.03 * exact[2]);
    EXPECT_NEAR(sum * 0.04, 1e-3 * 3, 1e-5);  // all matter of a cell: pixels of 0.04, a volume of 3
}

TEST(Splatting, BleedsOverTheEdgeByItsKernel) {
    // Matter in one half of the volume, the edge at x = 19.5: seen along y, two samples beyond it there is none.
    constexpr std::int64_t kSize = 40;
    const Volume volume = sampled(kSize, [](const Vec3& p) { return p[0] < 19.5 ? 1.0 : 0.0; });
    const SceneVolume matter = proportional(volume, 1);
    const auto beyond_edge = [&](ProjectionMethod method, double kernel) {
        const Camera camera{.target = {21.5, 19.5, 19.5}, .view = {}, .height = 1};
        return opacity_in_the_middle(project_by(method, matter, camera, {.width = 1, .height = 1, .step = 0.1, .kernel = kernel}));
    };
    EXPECT_LT(beyond_edge(ProjectionMethod::ray_casting, 1), 0.01);  // but for the entries of the transfer function's table
    EXPECT_LT(beyond_edge(ProjectionMethod::shear_warp, 1), 0.01);
    EXPECT_GT(beyond_edge(ProjectionMethod::splatting, 1), 0.4);  // 40 samples deep, and two deviations away
    EXPECT_GT(beyond_edge(ProjectionMethod::splatting, 1), 1.5 * beyond_edge(ProjectionMethod::splatting, 0.8));
}

TEST(Splatting, SheetsPopWhereTheirDirectionChanges) {
    // At 45 degrees the sheets turn by a right angle. Dense matter of two colours: which of them covers the other changes at once.
    constexpr std::int64_t kSize = 32;
    const Volume volume =
        sampled(kSize, [](const Vec3& p) { return 0.5 + 0.5 * std::sin(1.9 * p[0]) * std::sin(2.1 * p[1] + 1) * std::sin(p[2]); });
    SceneVolume matter{.volume = &volume, .range = std::array<double, 2>{0, 1}};
    matter.tents = {{.low = 0, .high = 0.45, .colour = {1, 0, 0}, .density = 2, .ramp = 0.2},
                    {.low = 0.55, .high = 1, .colour = {0, 0, 1}, .density = 2, .ramp = 0.2}};
    const ProjectionOptions options{.width = 24, .height = 24, .step = 1.0 / 32};
    const auto change = [&](ProjectionMethod method, double from, double to) {
        return picture_error(project_by(method, matter, camera_from(kSize, from, 0, 24), options),
                             project_by(method, matter, camera_from(kSize, to, 0, 24), options))
            .root_mean_square;
    };
    // Beside the change of a turn by the same angle that turns no sheets.
    const auto jump = [&](ProjectionMethod method) { return change(method, 44.9, 45.1) / change(method, 44.7, 44.9); };
    EXPECT_GT(jump(ProjectionMethod::splatting), 5);
    EXPECT_LT(jump(ProjectionMethod::ray_casting), 1.5);
}

TEST(ShearWarp, MissesWhatLiesBetweenSlicesAt45Degrees) {
    // A chessboard. Along a diagonal every slice has the same colour; between two slices, where shear-warp does not look, lies the other
    // one.
    constexpr std::int64_t kSize = 64;
    const Volume volume = sampled(kSize, [](const Vec3& p) { return std::fmod(p[0] + p[1], 2.0); });
    const SceneVolume matter = proportional(volume, 0.02);
    const ProjectionOptions options{.width = 64, .height = 3, .step = 0.125};
    const auto error = [&](double around) {
        const Camera camera = camera_from(kSize, around, 0, 1);  // 21 samples across
        return picture_error(project_by(ProjectionMethod::shear_warp, matter, camera, options),
                             projected_integral(matter, camera, options));
    };
    EXPECT_LT(error(0).largest, 0.02);
    EXPECT_GT(error(45).largest, 0.15);
}

TEST(ShearWarp, LooksAtEachSliceOnceHoweverLongTheRay) {
    constexpr std::int64_t kSize = 32;
    const Volume volume = sampled(kSize, [](const Vec3&) { return 1.0; });
    const SceneVolume matter = proportional(volume, 0.001);
    for (const double around : {0.0, 30.0, 45.0}) {
        const ProjectedPicture picture =
            project_by(ProjectionMethod::shear_warp, matter, camera_from(kSize, around, 0, 40), {.width = 8, .height = 8});
        EXPECT_NEAR(static_cast<double>(picture.samples), 32 * 33 * 33, 32 * 33) << around;
    }
}

TEST(ProjectionMethods, RefuseWhatTheyDoNotProject) {
    const Volume volume = sampled(4, [](const Vec3&) { return 1.0; });
    const SceneVolume matter = proportional(volume, 0.1);
    const Camera camera = camera_from(4, 0, 0, 4);
    const auto refused = [](const SceneVolume& what, const Camera& from, const ProjectionOptions& options) {
        try {
            static_cast<void>(project_by(ProjectionMethod::splatting, what, from, options));
        } catch (const Error& error) {
            return error.kind() == ErrorKind::usage;
        }
        return false;
    };
    EXPECT_FALSE(refused(matter, camera, {.width = 2, .height = 2}));
    EXPECT_TRUE(refused({}, camera, {}));
    EXPECT_TRUE(refused(matter, camera, {.width = 0}));
    EXPECT_TRUE(refused(matter, camera, {.step = 0}));
    EXPECT_TRUE(refused(matter, camera, {.kernel = std::nan("")}));
    Camera perspective = camera;
    perspective.projection = Projection::perspective;
    EXPECT_TRUE(refused(matter, perspective, {}));
    const ProjectedPicture two = project_by(ProjectionMethod::ray_casting, matter, camera, {.width = 2, .height = 2});
    const ProjectedPicture three = project_by(ProjectionMethod::ray_casting, matter, camera, {.width = 3, .height = 2});
    EXPECT_THROW(static_cast<void>(picture_error(two, three)), Error);
    EXPECT_EQ(image_of(two).rgba.size(), 16U);
}

}  // namespace
}  // namespace isoatlas
