// Volumes as glowing matter against integrals that are known: a ball of constant density, density that falls linearly from a centre.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "isoatlas/render.h"
#include "render/medium.h"
#include "render/scene_box.h"
#include "unit/render/shapes.h"

namespace isoatlas {
namespace {

constexpr double kBall = 20;  // radius, physical

/// Samples of kBall - distance from the centre, on a grid with unequal, turned axes.
Volume cone_volume(std::int64_t size) {
    Geometry geometry;
    const double spacing = 48.0 / static_cast<double>(size - 1);
    geometry.spacing = {spacing, spacing, 2 * spacing};
    geometry.direction = {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}};
    geometry.origin = {-24, 24, -24};
    Volume volume = make_volume({.rank = 3, .size = {size, size, (size + 1) / 2}}, ValueType::f32, geometry);
    for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i) {
        const auto at = volume.info.extent.voxel(i);
        const Vec3 p = to_physical(geometry, {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
        volume.samples<float>()[i] = static_cast<float>(kBall - std::hypot(p[0], p[1], p[2]));
    }
    return volume;
}

RenderOptions flat(std::int64_t size, int samples = 4) {
    return {.width = size, .height = size, .background = Background::transparent, .samples = samples, .shading = false};
}

/// Compares the opacity of every pixel with 1 - exp(-integral of the extinction along its ray), given by its distance from the centre.
void expect_opacities(const Image& image, double height, const std::function<double(double)>& integral, double tolerance) {
    const double pixel = height / static_cast<double>(image.height);
    for (std::int64_t y = 0; y < image.height; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            const double u = (static_cast<double>(x) + 0.5 - static_cast<double>(image.width) / 2) * pixel;
            const double v = (static_cast<double>(y) + 0.5 - static_cast<double>(image.height) / 2) * pixel;
            const double d = std::hypot(u, v);
            if (std::abs(d - kBall) < pixel) continue;  // a pixel at the rim is partly covered
            ASSERT_NEAR(image.at(x, y)[3] / 255.0, 1 - std::exp(-integral(d)), tolerance) << x << ' ' << y;
        }
    }
}

TEST(Medium, BallOfConstantDensity) {
    const Volume volume = cone_volume(97);
    const double density = 0.03;
    Scene scene;
    scene.volume = {.volume = &volume, .tents = {{.low = 0, .high = 100, .colour = {1, 1, 1}, .density = density, .ramp = 0}}};
    for (const Vec3& toward : {Vec3{0, -1, 0}, Vec3{0.6, 0, 0.8}}) {
        const Camera camera{.target = {0, 0, 0}, .view = {.toward = toward, .up = {0, 0, 1}}, .height = 44};
        const auto chord = [&](double d) { return d < kBall ? 2 * density * std::sqrt(kBall * kBall - d * d) : 0; };
        expect_opacities(render_scene(scene, camera, flat(44, 1)), 44, chord, 0.012);
    }
}

TEST(Medium, LinearRamp) {
    const Volume volume = cone_volume(97);
    const double top = 0.1;
    Scene scene;  // the extinction rises from 0 at the rim to `top` at the centre
    scene.volume = {.volume = &volume, .tents = {{.low = 0, .high = 2 * kBall, .colour = {1, 1, 1}, .density = top, .ramp = 0.5}}};
    const Camera camera{.target = {0, 0, 0}, .view = {}, .height = 44};
    const auto integral = [&](double d) {
        if (d >= kBall) return 0.0;
        const double half = std::sqrt(kBall * kBall - d * d);
        // of R - sqrt(d^2 + s^2) over s from -half to half
        const double of_root = half * kBall + (d > 0 ? d * d * std::asinh(half / d) : 0);
        return top / kBall * (2 * kBall * half - of_root);
    };
    expect_opacities(render_scene(scene, camera, flat(44, 1)), 44, integral, 0.012);
}

TEST(Medium, AnySampleDistanceGivesTheIntegralOfAConstant) {
    Volume volume = make_volume({.rank = 3, .size = {12, 9, 7}}, ValueType::u8);
    for (std::uint8_t& sample : volume.samples<std::uint8_t>()) sample = 100;
    Scene scene;
    scene.volume = {.volume = &volume, .tents = {{.low = 50, .high = 150, .colour = {1, 1, 1}, .density = 0.2, .ramp = 0}}};
    const Camera camera{.target = {5.5, 4, 3}, .view = {.toward = {0, 0, 1}, .up = {0, 1, 0}}, .height = 4};
    const int opacity = static_cast<int>(std::lround(255 * (1 - std::exp(-0.2 * 6))));  // six voxels deep
    for (const double distance : {0.05, 0.3, 1.0, 1.7, 4.0, 16.0}) {
        scene.volume.sample_distance = distance;
        EXPECT_EQ(render_scene(scene, camera, flat(5, 1)).at(2, 2)[3], opacity) << distance;
    }
    for (const double distance : {0.0, 0.04, 17.0, std::nan("")}) {
        scene.volume.sample_distance = distance;
        EXPECT_THROW(static_cast<void>(render_scene(scene, camera, flat(5, 1))), Error) << distance;
    }
}

TEST(Medium, ColourAndDepthOrderWithSurfaces) {
    const Volume volume = cone_volume(49);
    const double density = 0.02;
    const auto scene_with = [&](double opacity) {
        Scene scene;
        scene.volume = {.volume = &volume, .tents = {{.low = 0, .high = 100, .colour = {1, 0, 0}, .density = density, .ramp = 0}}};
        scene.objects.push_back({.surface = test::ball({0, 0, 0}, 5, 1), .colour = {0, 0, 1}, .opacity = opacity});
        return scene;
    };
    const Camera camera{.target = {0, 0, 0}, .view = {}, .height = 44};
    const auto linear = [](std::uint8_t b) { return std::pow((b / 255.0 + 0.055) / 1.055, 2.4); };
    const double in_front = 1 - std::exp(-density * 15), inside = 1 - std::exp(-density * 10);
    // Opaque: matter in front of it, nothing behind.
    const Image opaque = render_scene(scene_with(1), camera, flat(45, 1));
    EXPECT_EQ(opaque.at(22, 22)[3], 255);
    EXPECT_NEAR(linear(opaque.at(22, 22)[0]), in_front, 0.015);
    EXPECT_NEAR(linear(opaque.at(22, 22)[2]), 1 - in_front, 0.015);
    // Two sheets: matter, sheet, matter, sheet, matter.
    const double sheet = 0.4;
    const Image glass = render_scene(scene_with(sheet), camera, flat(45, 1));
    double through = 1, red = 0;
    for (const double part : {in_front, -1.0, inside, -1.0, in_front}) {
        if (part > 0) red += through * part;
        through *= part > 0 ? 1 - part : 1 - sheet;
    }
    EXPECT_NEAR(glass.at(22, 22)[3] / 255.0, 1 - through, 0.01);
    EXPECT_NEAR(linear(glass.at(22, 22)[0]) * (1 - through), red, 0.015);
}

TEST(Medium, LeapsOverNothingThatIsVisible) {
    // One bright voxel in an empty volume: whatever block it lies in, it is seen.
    for (const std::int64_t at : {0, 7, 8, 9, 15, 16, 20}) {
        Volume volume = make_volume({.rank = 3, .size = {21, 21, 21}}, ValueType::u8);
        volume.samples<std::uint8_t>()[volume.info.extent.index(at, at, 10)] = 200;
        Scene scene;
        scene.volume = {.volume = &volume, .tents = {{.low = 50, .high = 255, .colour = {1, 1, 1}, .density = 50, .ramp = 0}}};
        const Camera camera{
            .target = {static_cast<double>(at), static_cast<double>(at), 10}, .view = {.toward = {0, 0, 1}, .up = {0, 1, 0}}, .height = 3};
        EXPECT_GT(render_scene(scene, camera, flat(17, 1)).at(8, 8)[3], 250) << at;
    }
}

/// A few bright and a few dim samples in the dark.
Volume sparse_volume(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](std::int64_t n) { return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n)); };
    Geometry geometry;
    geometry.spacing = {1, 1.5, 0.75};
    Volume volume = make_volume({.rank = 3, .size = {1 + below(70), 1 + below(40), 1 + below(40)}}, ValueType::u8, geometry);
    for (std::int64_t n = 1 + below(5); n > 0; --n)
        volume.samples<std::uint8_t>()[below(volume.info.extent.voxels())] = static_cast<std::uint8_t>(40 + below(216));
    return volume;
}

TEST(Medium, LeapingChangesNoPixel) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Volume volume = sparse_volume(seed);
        Scene scene;
        scene.volume = {.volume = &volume,
                        .tents = {{.low = 10, .high = 60, .colour = {1, 0.5, 0}, .density = 2, .ramp = 0.1},
                                  {.low = 100, .high = 110, .colour = {0, 0.5, 1}, .density = 5, .ramp = 0}}};
        if (seed % 3 == 0) scene.removed = {{.normal = {1, 1, 0}, .offset = 4}};
        const RenderOptions options{.width = 40, .height = 40, .background = Background::dark};
        const Camera camera = fit_camera(scene, view_from(static_cast<double>(37 * seed % 360), static_cast<double>(seed % 90)), options);
        const Image leapt = render_scene(scene, camera, options);
        // What is everywhere cannot be leapt over, even when it is too thin to be seen.
        scene.volume.tents.push_back({.low = -1, .high = 256, .colour = {1, 1, 1}, .density = 1e-12, .ramp = 0});
        EXPECT_TRUE(render_scene(scene, camera, options) == leapt) << seed;
    }
}

TEST(Medium, TheSameBytesForAnyThreads) {
    const Volume volume = cone_volume(33);
    Scene scene;
    scene.volume = {.volume = &volume, .tents = {{.low = 0, .high = 15, .colour = {1, 0.5, 0}, .density = 0.2}}, .shadows = true};
    scene.objects.push_back({.surface = test::ball({3, 1, 0}, 5, 1), .colour = {0, 0, 1}});
    scene.removed = {{.normal = {1, 0, 0}, .offset = 8}};
    const RenderOptions options{.width = 64, .height = 48};
    const Camera camera = fit_camera(scene, view_from(30, 20), options);
    Context context;
    context.threads = 1;
    const Image one = render_scene(scene, camera, options, context);
    for (context.threads = 2; context.threads <= 3; ++context.threads) EXPECT_TRUE(render_scene(scene, camera, options, context) == one);
}

TEST(Medium, ShadowsDarkenWhatLiesBehind) {
    const Volume volume = cone_volume(49);
    Scene scene;
    scene.volume = {.volume = &volume, .tents = {{.low = 0, .high = 100, .colour = {1, 1, 1}, .density = 0.3, .ramp = 0}}};
    const Camera camera = fit_camera(scene, view_from(0, 0));
    const RenderOptions options{.width = 32, .height = 32, .background = Background::transparent};
    const auto brightness = [&] {
        const Image image = render_scene(scene, camera, options);
        double sum = 0;
        for (std::size_t i = 0; i < image.rgba.size(); i += 4) sum += image.rgba[i] * image.rgba[i + 3];
        return sum;
    };
    const double lit = brightness();
    scene.volume.shadows = true;
    EXPECT_LT(brightness(), 0.97 * lit);
}

TEST(Medium, LightComesAsFarAsTheIntegralSays) {
    const Volume volume = cone_volume(97);
    const double density = 0.05;
    Scene scene;
    scene.volume = {
        .volume = &volume, .tents = {{.low = 0, .high = 100, .colour = {1, 1, 1}, .density = density, .ramp = 0}}, .shadows = true};
    const SceneBox box = box_of(scene);
    const Frame frame{box.centre(), box.radius()};
    const CameraRays camera({.view = view_from(20, 30)}, 8, 8);
    const Lights lights(camera);
    const std::vector<HalfSpace> none;
    const RaySurfaces nothing(scene, RaySurfaces::Which::opaque, frame, none, 1);
    const Medium medium(scene, frame, &lights, nothing, 2);
    const Vec3 key = lights.to_key({0, 0});
    for (const double distance : {-15.0, -8.0, 0.0, 6.0, 14.0}) {  // from the centre towards the light
        const Vec3 point = frame.inside(scale(key, distance));
        EXPECT_NEAR(medium.lit(point), std::exp(-density * (kBall - distance)), 0.02) << distance;
    }
}

TEST(Slice, GreyValuesAndPlace) {
    Geometry geometry;
    geometry.spacing = {1, 2, 3}, geometry.origin = {10, 20, 30};
    Volume volume = make_volume({.rank = 3, .size = {4, 3, 2}}, ValueType::u8, geometry);
    for (std::int64_t i = 0; i < 24; ++i) volume.samples<std::uint8_t>()[i] = static_cast<std::uint8_t>(10 * i);
    const SceneSlice slice = slice_picture(volume, {.axis = 2, .index = 1, .black = 120, .white = 230, .side = 40});
    EXPECT_EQ(slice.picture.width, 30);
    EXPECT_EQ(slice.picture.height, 40);
    EXPECT_EQ(slice.corner, (Vec3{10, 20, 33}));
    EXPECT_EQ(slice.across, (Vec3{3, 0, 0}));
    EXPECT_EQ(slice.down, (Vec3{0, 4, 0}));
    EXPECT_LT(slice.picture.at(0, 0)[0], 5);
    EXPECT_GT(slice.picture.at(29, 39)[0], 250);
    const SceneSlice side = slice_picture(volume, {.axis = 0, .index = 3, .side = 40});
    EXPECT_EQ(side.corner, (Vec3{13, 20, 33}));
    EXPECT_EQ(side.down, (Vec3{0, 0, -3}));
    EXPECT_THROW(static_cast<void>(slice_picture(volume, {.axis = 1, .index = 3})), Error);
}

TEST(Slice, LiesOnACutFace) {
    const Volume volume = cone_volume(49);
    Scene scene{.objects = {{.surface = test::ball({0, 0, 0}, 15, 1), .colour = {1, 0, 0}}}};
    scene.slices.push_back(slice_picture(volume, {.axis = 2, .index = 12, .side = 100}));
    scene.removed = {{.normal = {0, 0, 1}, .offset = scene.slices[0].corner[2]}};  // everything above the slice
    const Camera camera{.target = {0, 0, 0}, .view = view_from(25, 50), .height = 40};
    const Image image = render_scene(scene, camera, {.width = 60, .height = 60});
    scene.objects.clear();
    const Image slice = render_scene(scene, camera, {.width = 60, .height = 60});
    for (std::int64_t y = 27; y < 33; ++y) {
        for (std::int64_t x = 20; x < 40; ++x) ASSERT_EQ(image.at(x, y)[0], slice.at(x, y)[0]) << x << ' ' << y;
    }
}

TEST(Slice, ContoursAreWhereTheSurfaceIs) {
    const Volume volume = cone_volume(49);
    const double tau = 8;
    const SceneSlice slice = slice_picture(volume, {.axis = 2, .index = 12, .contours = {{.tau = tau, .colour = {1, 0, 0}}}, .side = 300});
    std::int64_t red = 0;
    for (std::int64_t y = 0; y < slice.picture.height; ++y) {
        for (std::int64_t x = 0; x < slice.picture.width; ++x) {
            const std::uint8_t* p = slice.picture.at(x, y);
            if (p[0] < p[1] + 60) continue;
            ++red;
            const double u = (static_cast<double>(x) + 0.5) / static_cast<double>(slice.picture.width);
            const double v = (static_cast<double>(y) + 0.5) / static_cast<double>(slice.picture.height);
            Vec3 place{};
            for (int a = 0; a < 3; ++a) place[a] = slice.corner[a] + u * slice.across[a] + v * slice.down[a];
            ASSERT_NEAR(std::hypot(place[0], place[1], place[2]), kBall - tau, 0.35);
        }
    }
    EXPECT_GT(red, 300);
}

}  // namespace
}  // namespace isoatlas
