// Optical models against what is known in closed form: slabs and balls of constant density, the half space of Chandrasekhar, a white
// furnace.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "isoatlas/render.h"
#include "render/colours.h"
#include "render/optics.h"
#include "render/scene_box.h"
#include "render/tracer.h"
#include "unit/render/shapes.h"

namespace isoatlas {
namespace {

/// A block of constant value. Its matter has the extinction `density` and a linear colour of 1, 0.5, 0.
Volume block(std::int64_t x, std::int64_t y, std::int64_t z) {
    Volume volume = make_volume({.rank = 3, .size = {x, y, z}}, ValueType::u8);
    for (std::uint8_t& sample : volume.samples<std::uint8_t>()) sample = 100;
    return volume;
}

/// Samples of 20 - distance from the centre, on a grid from -24 to 24.
Volume ball_volume(std::int64_t size) {
    Geometry geometry;
    const double spacing = 48.0 / static_cast<double>(size - 1);
    geometry.spacing = {spacing, spacing, spacing}, geometry.origin = {-24, -24, -24};
    Volume volume = make_volume({.rank = 3, .size = {size, size, size}}, ValueType::f32, geometry);
    for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i) {
        const auto at = volume.info.extent.voxel(i);
        const Vec3 p = to_physical(geometry, {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
        volume.samples<float>()[i] = static_cast<float>(20 - norm(p));
    }
    return volume;
}

const Vec3 kColour = linear({1, 0.5, 0});

/// What one ray sees, in physical coordinates.
class Matter {
public:
    Matter(const Volume& volume, double density, OpticalModel model, const Scattering& scattering = {}, double sample_distance = 1)
        : scene_{.volume = {.volume = &volume,
                            .tents = {{.low = 0, .high = 200, .colour = {1, 0.5, 0}, .density = density, .ramp = 0}},
                            .sample_distance = sample_distance,
                            .optics = model,
                            .scattering = scattering}} {}
    void add(SceneObject object) { scene_.objects.push_back(std::move(object)); }
    void remove(const HalfSpace& half) { scene_.removed.push_back(half); }
    void colour(const Colour& colour) { scene_.volume.tents[0].colour = colour; }

    [[nodiscard]] Gathered look(const Vec3& origin, const Vec3& direction, int samples = 1) {
        if (!tracer_) {
            const SceneBox box = box_of(scene_);
            frame_ = {box.centre(), box.radius()};
            tracer_.emplace(scene_, frame_, CameraRays({}, 8, 8), false, 1);
        }
        Gathered sum;
        Workspace work;
        for (int i = 0; i < samples; ++i) {
            const Seen seen = tracer_->trace({frame_.inside(origin), unit(direction)}, 17, static_cast<std::uint32_t>(i), work);
            sum.light = along(sum.light, 1.0 / samples, seen.glow), sum.opacity += seen.opacity / samples;
        }
        return sum;
    }

private:
    Scene scene_;
    Frame frame_;
    std::optional<Tracer> tracer_;
};

void expect_light(const Gathered& seen, double expected, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen.light[c], expected * kColour[c], tolerance * kColour[c] + 1e-12) << c;
}

/// A slab from z = 0 to 10, seen from below, upright and slanting.
class Slab : public testing::Test {
protected:
    Volume volume = block(81, 5, 11);
    double density = 0.15;
    const Vec3 below{40, 2, -5};
    static double thickness(const Vec3& way) { return 10 / unit(way)[2]; }
    static Vec3 eye(const Vec3& way) { return {40 - 5 * way[0] / way[2], 2, -5}; }
    static constexpr Vec3 kWays[] = {{0, 0, 1}, {0.5, 0, 1}, {-1.5, 0, 1}};
};

TEST_F(Slab, AbsorptionIsThatOfBeerAndLambert) {
    for (const Vec3& way : kWays) {
        for (const double distance : {0.3, 1.0, 4.0}) {
            const Gathered seen = Matter(volume, density, OpticalModel::absorption, {}, distance).look(eye(way), way);
            EXPECT_NEAR(1 - seen.opacity, std::exp(-density * thickness(way)), 1e-6);
            EXPECT_EQ(seen.light, (Vec3{0, 0, 0}));
        }
    }
}

TEST_F(Slab, EmissionGrowsWithItsThicknessAndHidesNothing) {
    for (const Vec3& way : kWays) {
        const Gathered seen = Matter(volume, density, OpticalModel::emission).look(eye(way), way);
        EXPECT_EQ(seen.opacity, 0);
        expect_light(seen, density * thickness(way), 1e-6);
    }
}

TEST_F(Slab, EmissionAndAbsorptionSaturate) {
    for (const Vec3& way : kWays) {  // (q / s) (1 - exp(-s L)), q = s C
        const Gathered seen = Matter(volume, density, OpticalModel::absorption_emission).look(eye(way), way);
        expect_light(seen, 1 - std::exp(-density * thickness(way)), 1e-6);
        EXPECT_NEAR(seen.opacity, 1 - std::exp(-density * thickness(way)), 1e-6);
    }
}

TEST_F(Slab, SingleScatteringOfALampAtTheEyeAndBehindTheSlab) {
    for (const double distance : {0.3, 1.0, 4.0}) {
        for (const double g : {0.0, 0.6, -0.4}) {
            // From the eye: the light has passed as much as it will pass: the integral of s exp(-2 s z).
            const Scattering front{.albedo = 0.7, .asymmetry = g, .to_light = {0, 0, -1}};
            const Gathered lit = Matter(volume, density, OpticalModel::single_scattering, front, distance).look(below, {0, 0, 1});
            expect_light(lit, 0.7 * phase_of(g, -1) * (1 - std::exp(-2 * density * 10)) / 2, 1e-4);
            // From behind: it passes the whole slab, wherever it is scattered. One place stands for a segment of depth x: tanh(x / 2) of
            // x / 2 is left, x^2 / 12 less.
            const Scattering back{.albedo = 0.7, .asymmetry = g, .to_light = {0, 0, 1}};
            const Gathered through = Matter(volume, density, OpticalModel::single_scattering, back, distance).look(below, {0, 0, 1});
            const double s = density * 10, x = density * distance, exact = 0.7 * phase_of(g, 1) * s * std::exp(-s);
            expect_light(through, exact, exact * (x * x / 12 + 1e-4));
        }
    }
}

TEST_F(Slab, SingleScatteringOfALampAside) {
    // The lamp at 60 degrees above the side of the eye: light passes 2 z to depth z.
    const Vec3 lamp{std::sqrt(0.75), 0, -0.5};
    const Volume wide = block(161, 3, 11);
    const Gathered lit =
        Matter(wide, density, OpticalModel::single_scattering, {.asymmetry = 0.3, .to_light = lamp}, 0.25).look({80, 1, -5}, {0, 0, 1});
    expect_light(lit, phase_of(0.3, -0.5) * (1 - std::exp(-3 * density * 10)) / 3, 5e-4);
}

TEST(Phase, HasTheMeanOneAndTheAsymmetryThatIsAskedFor) {
    for (const double g : {-0.9, -0.3, 0.0, 0.5, 0.95}) {
        double sum = 0, cosines = 0, drawn = 0;
        constexpr int kSteps = 200000;
        for (int i = 0; i < kSteps; ++i) {
            const double cosine = -1 + 2 * (i + 0.5) / kSteps;
            sum += phase_of(g, cosine) / kSteps, cosines += cosine * phase_of(g, cosine) / kSteps;
            drawn += phase_cosine(g, (i + 0.5) / kSteps) / kSteps;
        }
        EXPECT_NEAR(sum, 1, 1e-4) << g;
        EXPECT_NEAR(cosines, g, 1e-4) << g;
        EXPECT_NEAR(drawn, g, 1e-4) << g;
    }
}

/// Light of a ball of radius 20 that a ray at distance d from its centre sees, along z, by the simplest loop.
double ball_light(double d, double density, const Vec3& lamp) {
    const double half = std::sqrt(400 - d * d), step = half / 4000;
    double light = 0;
    for (double z = -half + step / 2; z < half; z += step) {
        const Vec3 p{d, 0, z};
        const double b = dot(p, lamp), to_lamp = -b + std::sqrt(b * b - dot(p, p) + 400);
        light += step * density * std::exp(-density * (z + half)) * std::exp(-density * to_lamp);
    }
    return light;
}

TEST(Ball, ChordsAbsorbAndGlow) {
    const Volume volume = ball_volume(97);
    const double density = 0.04;
    for (const double d : {0.0, 7.0, 13.0, 18.0}) {
        const double chord = 2 * std::sqrt(400 - d * d);
        const auto seen = [&](OpticalModel model) { return Matter(volume, density, model, {}, 0.25).look({d, 0, -30}, {0, 0, 1}); };
        EXPECT_NEAR(seen(OpticalModel::absorption).opacity, 1 - std::exp(-density * chord), 0.003) << d;
        expect_light(seen(OpticalModel::emission), density * chord, 0.015);
        expect_light(seen(OpticalModel::absorption_emission), 1 - std::exp(-density * chord), 0.003);
    }
}

TEST(Ball, SingleScatteringIsItsIntegral) {
    const Volume volume = ball_volume(97);
    const double density = 0.06;
    for (const Vec3& lamp : {Vec3{0, 0, -1}, Vec3{1, 0, 0}, unit(Vec3{-1, 0.5, -1}), Vec3{0, 0, 1}}) {
        for (const double d : {0.0, 9.0, 16.0}) {
            const Gathered seen =
                Matter(volume, density, OpticalModel::single_scattering, {.to_light = lamp}, 0.5).look({d, 0, -30}, {0, 0, 1});
            expect_light(seen, ball_light(d, density, lamp), 0.005);
        }
    }
}

TEST(Scatters, WhiteMatterInAWhiteFurnaceIsNotSeen) {
    // As much light comes from every direction as goes: every path ends in the sky, and carries all of it.
    const Volume volume = ball_volume(49);
    for (const double g : {0.0, 0.8, -0.5}) {
        Matter matter(volume, 0.2, OpticalModel::multiple_scattering, {.albedo = 1, .asymmetry = g, .light = 0, .sky = 1});
        matter.colour({1, 1, 1});
        for (const double d : {0.0, 11.0, 19.0}) {
            const Gathered seen = matter.look({d, 0, -30}, {0, 0, 1}, 20);
            EXPECT_GT(seen.opacity, 0.5);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen.light[c] + 1 - seen.opacity, 1, 1e-9) << d;
        }
    }
}

TEST(Scatters, DarkMatterScattersOnce) {
    // Each further event costs the albedo once more.
    const Volume volume = ball_volume(49);
    for (const double albedo : {0.1, 0.01, 0.001}) {
        const Scattering scattering{.albedo = albedo, .to_light = {1, 0, 0}};
        const Gathered once = Matter(volume, 0.1, OpticalModel::single_scattering, scattering).look({5, 0, -30}, {0, 0, 1}, 8);
        const Gathered often = Matter(volume, 0.1, OpticalModel::multiple_scattering, scattering).look({5, 0, -30}, {0, 0, 1}, 8);
        EXPECT_GT(often.light[0], once.light[0]);
        EXPECT_NEAR(often.light[0] / once.light[0], 1, 1.5 * albedo);
    }
}

/// The H function of isotropic scattering in a half space, by iteration of its integral equation (Chandrasekhar, Radiative transfer, 1960).
double chandrasekhar(double mu, double albedo) {
    constexpr int kSteps = 400;
    const auto node = [](int i) { return (i + 0.5) / kSteps; };
    std::vector<double> h(kSteps, 1.0);
    const auto at = [&](double m) {
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) sum += node(i) * h[static_cast<std::size_t>(i)] / (m + node(i)) / kSteps;
        return 1 / (std::sqrt(1 - albedo) + albedo / 2 * sum);
    };
    for (int round = 0; round < 60; ++round) {
        std::vector<double> next;
        for (int i = 0; i < kSteps; ++i) next.push_back(at(node(i)));
        h = next;
    }
    return at(mu);
}

TEST(Scatters, AHalfSpaceIsAsBrightAsChandrasekharSays) {
    // 40 mean free paths wide and deep. The mean of n paths has an error of their deviation over the root of n: four of these are allowed.
    const Volume volume = block(41, 41, 41);
    constexpr int kPaths = 3000;
    for (const double albedo : {0.4, 0.8}) {
        for (const double mu0 : {1.0, 0.5}) {
            Matter matter(volume, 1, OpticalModel::multiple_scattering, {.albedo = albedo, .to_light = {std::sqrt(1 - mu0 * mu0), 0, -mu0}},
                          0.5);
            matter.colour({1, 1, 1});
            const double bright = albedo * mu0 / (1 + mu0) * chandrasekhar(1, albedo) * chandrasekhar(mu0, albedo);
            const double mean = matter.look({20, 20, -5}, {0, 0, 1}, kPaths).light[0];
            EXPECT_NEAR(mean / bright, 1, 4 * 0.6 / std::sqrt(kPaths)) << albedo << ' ' << mu0;
            const double once = albedo * mu0 / (1 + mu0);
            EXPECT_GT(mean, 1.2 * once);
        }
    }
}

TEST(Scatters, AHalfSpaceUnderTheSkyAbsorbsAsMuchAsItWouldEmit) {
    // By the law of Kirchhoff, 1 - sqrt(1 - albedo) H(1) of a sky of 1 comes back.
    const Volume volume = block(41, 41, 41);
    constexpr int kPaths = 2000;
    for (const double albedo : {0.5, 0.9}) {
        Matter matter(volume, 1, OpticalModel::multiple_scattering, {.albedo = albedo, .light = 0, .sky = 1}, 0.5);
        matter.colour({1, 1, 1});
        const double bright = 1 - std::sqrt(1 - albedo) * chandrasekhar(1, albedo);
        EXPECT_NEAR(matter.look({20, 20, -5}, {0, 0, 1}, kPaths).light[0] / bright, 1, 4 * 1.1 / std::sqrt(kPaths)) << albedo;
    }
}

TEST(Scatters, TheErrorFallsWithTheRootOfThePaths) {
    const Volume volume = ball_volume(49);
    Matter matter(volume, 0.15, OpticalModel::multiple_scattering, {.albedo = 0.9, .to_light = {1, 0, -1}});
    const auto mean_error = [&](int paths, double exact) {  // over 24 rays at one distance from the centre, where they see the same
        double squares = 0;
        for (int i = 0; i < 24; ++i) {
            const double y = 6 + 0.001 * i;
            const double error = matter.look({0, y, -30 - 0.37 * i}, {0, 0, 1}, paths).light[0] - exact;
            squares += error * error / 24;
        }
        return std::sqrt(squares);
    };
    const double exact = matter.look({0, 6.01, -30}, {0, 0, 1}, 20000).light[0];
    const double few = mean_error(16, exact), many = mean_error(256, exact);
    EXPECT_LT(few, 0.5 * exact / 4);
    EXPECT_NEAR(few / many, 4, 2);
}

TEST(Scatters, WhatIsCutAwayTakesNoLight) {
    // The half of the block that is nearer to the lamp is cut away: the rest is lit as if it were alone.
    const Volume whole = block(21, 5, 41), half = block(21, 5, 21);
    const Scattering scattering{.to_light = {0, 0, 1}};
    for (const OpticalModel model : {OpticalModel::single_scattering, OpticalModel::absorption, OpticalModel::emission}) {
        Matter cut(whole, 0.1, model, scattering, 0.25), alone(half, 0.1, model, scattering, 0.25);
        cut.remove({.normal = {0, 0, 1}, .offset = 20});
        const Gathered a = cut.look({10, 2, -5}, {0, 0, 1}), b = alone.look({10, 2, -5}, {0, 0, 1});
        EXPECT_NEAR(a.opacity, b.opacity, 1e-3);
        EXPECT_NEAR(a.light[0], b.light[0], 2e-3);
    }
}

TEST(Scatters, SurfacesCastShadows) {
    const Volume volume = block(41, 41, 11);
    const Scattering scattering{.to_light = {0, 0, 1}};
    for (const OpticalModel model : {OpticalModel::single_scattering, OpticalModel::multiple_scattering}) {
        Matter open(volume, 0.02, model, scattering), shaded(volume, 0.02, model, scattering);
        shaded.add({.surface = test::ball({20, 20, 100}, 5, 1), .colour = {0, 0, 0}});
        const auto at = [](Matter& matter, double x) { return matter.look({x, 20, -5}, {0, 0, 1}, 4).light[0]; };
        EXPECT_LT(at(shaded, 20), 0.1 * at(open, 20));
        EXPECT_GT(at(shaded, 30), 0.9 * at(open, 30));
    }
}

TEST(Scatters, SurfacesHideTheSky) {
    const Volume volume = block(21, 21, 21);
    const Scattering scattering{.light = 0, .sky = 1};
    Matter open(volume, 0.1, OpticalModel::multiple_scattering, scattering),
        inside(volume, 0.1, OpticalModel::multiple_scattering, scattering);
    inside.add({.surface = test::ball({10, 10, 10}, 60, 1), .colour = {0, 0, 0}});
    EXPECT_GT(open.look({10, 10, -5}, {0, 0, 1}, 8).light[0], 0.3);
    EXPECT_EQ(inside.look({10, 10, -5}, {0, 0, 1}, 8).light[0], 0);
}

TEST(Scatters, TheSameBytesForAnyThreads) {
    const Volume volume = ball_volume(17);
    Scene scene;
    scene.volume = {.volume = &volume,
                    .tents = {{.low = 0, .high = 15, .colour = {1, 0.5, 0}, .density = 0.2}},
                    .optics = OpticalModel::multiple_scattering,
                    .scattering = {.albedo = 0.9, .asymmetry = 0.3, .sky = 0.3}};
    const RenderOptions options{.width = 40, .height = 32, .samples = 2};
    const Camera camera = fit_camera(scene, view_from(30, 20), options);
    Context context;
    context.threads = 1;
    const Image one = render_scene(scene, camera, options, context);
    context.threads = 3;
    EXPECT_TRUE(render_scene(scene, camera, options, context) == one);
}

TEST(Optics, RefusesWhatIsOutOfRange) {
    const Volume volume = block(5, 5, 5);
    Scene good;
    good.volume = {.volume = &volume, .tents = {{.low = 0, .high = 200, .colour = {1, 1, 1}, .density = 0.1, .ramp = 0}}};
    const Camera camera = fit_camera(good, {});
    const auto refused = [&](const auto& change) {
        Scene scene = good;
        RenderOptions options{.width = 4, .height = 4, .samples = 1};
        change(scene.volume, options);
        try {
            static_cast<void>(render_scene(scene, camera, options));
        } catch (const Error& error) {
            return error.kind() == ErrorKind::usage;
        }
        return false;
    };
    EXPECT_FALSE(refused([](SceneVolume&, RenderOptions&) {}));
    EXPECT_TRUE(refused([](SceneVolume& v, RenderOptions&) { v.scattering.albedo = 1.01; }));
    EXPECT_TRUE(refused([](SceneVolume& v, RenderOptions&) { v.scattering.asymmetry = -1; }));
    EXPECT_TRUE(refused([](SceneVolume& v, RenderOptions&) { v.scattering.sky = std::nan(""); }));
    EXPECT_TRUE(refused([](SceneVolume& v, RenderOptions&) { v.scattering.light = -1; }));
    EXPECT_TRUE(refused([](SceneVolume& v, RenderOptions&) { v.scattering.to_light = {INFINITY, 0, 0}; }));
    EXPECT_TRUE(refused([](SceneVolume& v, RenderOptions&) { v.scattering.max_events = 0; }));
    EXPECT_TRUE(refused([](SceneVolume& v, RenderOptions&) { v.shadows = true, v.optics = OpticalModel::single_scattering; }));
    EXPECT_TRUE(
        refused([](SceneVolume& v, RenderOptions& o) { v.optics = OpticalModel::emission, o.background = Background::transparent; }));
}

}  // namespace
}  // namespace isoatlas
