// Pictures against geometry: where things appear, how large, how opaque, and the same bytes for any threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "isoatlas/render.h"
#include "unit/render/shapes.h"

namespace isoatlas {
namespace {

using test::ball;
using test::box;

SceneObject object(Surface surface, double opacity = 1, Colour colour = {1, 0.5, 0}) {
    return {.surface = std::move(surface), .colour = colour, .opacity = opacity, .name = "thing"};
}

RenderOptions flat_shaded(std::int64_t size, int samples = 16) {
    return {.width = size, .height = size, .background = Background::transparent, .samples = samples, .shading = false};
}

Context with_threads(int threads) {
    Context context;
    context.threads = threads;
    return context;
}

double alpha(const Image& image, std::int64_t x, std::int64_t y) { return image.at(x, y)[3] / 255.0; }

struct Extent2 {
    double area = 0, low = 0, high = 0;
};

/// Area in pixels, and where the row through the middle begins and ends.
Extent2 silhouette(const Image& image) {
    Extent2 extent;
    double row = 0;
    std::int64_t first = image.width;
    for (std::int64_t y = 0; y < image.height; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            extent.area += alpha(image, x, y);
            if (y != image.height / 2 || image.at(x, y)[3] == 0) continue;
            first = std::min(first, x);
            row += alpha(image, x, y);
        }
    }
    extent.low = static_cast<double>(first) + 1 - alpha(image, first, image.height / 2);
    extent.high = extent.low + row;
    return extent;
}

TEST(Render, SilhouetteOfABallIsWhereGeometrySays) {
    const Vec3 centre{1000, -20, 3};
    const Scene scene{.objects = {object(ball(centre, 7, 1))}};
    const RenderOptions options = flat_shaded(200);
    Camera camera{.target = {1001, -20, 4}, .view = {.toward = {0, -1, 0}, .up = {0, 0, 1}}, .height = 25};
    const Extent2 seen = silhouette(render_scene(scene, camera, options));
    const double radius = 7 / (25.0 / 200);
    EXPECT_NEAR(std::sqrt(seen.area / std::numbers::pi), radius, 0.5);
    const Vec3 middle = project(camera, options, centre);
    EXPECT_NEAR(middle[0], 92, 1e-9);
    EXPECT_NEAR(middle[1], 108, 1e-9);
    const double half = std::sqrt(radius * radius - 7.5 * 7.5);  // of the row of pixels 7.5 above the centre
    EXPECT_NEAR(seen.low, middle[0] - half, 0.5);
    EXPECT_NEAR(seen.high, middle[0] + half, 0.5);
}

/// Only its points, as discs that overlap.
SceneObject as_points(Surface surface, double radius) {
    surface.triangles.clear();
    SceneObject points = object(std::move(surface));
    points.point_radius = radius;
    return points;
}

TEST(Render, PointsLookLikeTheirSurface) {
    const Surface surface = ball({10, 0, 0}, 7, 1, 64);
    const Scene triangles{.objects = {object(surface)}}, discs{.objects = {as_points(surface, 0.5)}};
    const Camera camera{.target = {10, 0, 0}, .view = {.toward = {0, -1, 0}, .up = {0, 0, 1}}, .height = 20};
    const RenderOptions options{.width = 100, .height = 100, .background = Background::transparent, .samples = 16};
    const Image expected = render_scene(triangles, camera, options), seen = render_scene(discs, camera, options);
    double difference = 0, covered = 0;
    for (std::int64_t y = 0; y < 100; ++y) {
        for (std::int64_t x = 0; x < 100; ++x) {
            covered += alpha(expected, x, y);
            for (int channel = 0; channel < 4; ++channel) difference += std::abs(expected.at(x, y)[channel] - seen.at(x, y)[channel]);
        }
    }
    EXPECT_LT(difference / covered, 8);  // of 4 x 255: neighbouring discs meet at angles
    EXPECT_NEAR(silhouette(render_scene(discs, camera, flat_shaded(100))).area,
                silhouette(render_scene(triangles, camera, flat_shaded(100))).area, 40);
}

TEST(Render, PointsAreNotClosedWhereTheyAreCut) {
    const Scene cut{.objects = {as_points(ball({0, 0, 0}, 7, 1, 64), 0.3)}, .removed = {{{0, -1, 0}, 0}}};
    const Camera camera{.view = {.toward = {0, -1, 0}, .up = {0, 0, 1}}, .height = 20};
    const Image image = render_scene(cut, camera, {.width = 101, .height = 101, .background = Background::transparent});
    const Image whole =
        render_scene({.objects = cut.objects}, camera, {.width = 101, .height = 101, .background = Background::transparent});
    EXPECT_GT(alpha(image, 50, 50), 0.99);  // the inside of the far half
    EXPECT_NE(image.at(50, 30)[0], whole.at(50, 30)[0]);
}

TEST(Render, PerspectiveSilhouetteIsThatOfTheCone) {
    const Scene scene{.objects = {object(ball({0, 0, 0}, 1, 1))}};
    const Camera camera{.projection = Projection::perspective, .target = {0, 0, 0}, .view = {}, .height = 4, .distance = 3};
    const Extent2 seen = silhouette(render_scene(scene, camera, flat_shaded(200)));
    const double tangent = 1 / std::sqrt(3.0 * 3 - 1);  // half the angle under which the ball is seen
    EXPECT_NEAR(std::sqrt(seen.area / std::numbers::pi), 3 * tangent * 50, 0.5);
}

TEST(Render, FittedCamerasShowEverything) {
    const Scene scene{.objects = {object(box({0, 0, 0}, {40, 3, 9}, 1)), object(ball({50, 60, 70}, 5, 2))}};
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
        RenderOptions options = flat_shaded(120, 1);
        options.width = 160, options.projection = projection;
        const Camera camera = fit_camera(scene, {.toward = {0.6, -0.64, 0.48}, .up = {0, 0, 1}}, options);
        for (const SceneObject& o : scene.objects) {
            for (const Vec3& point : o.surface.points) {
                const Vec3 p = project(camera, options, point);
                EXPECT_TRUE(p[0] > 0 && p[0] < 160 && p[1] > 0 && p[1] < 120);
            }
        }
    }
}

TEST(Render, NestedShellsLetLightThroughAsTheFormulaSays) {
    const double outer = 0.3, inner = 0.45;
    const Colour red{1, 0, 0}, blue{0, 0, 1};
    const Scene scene{.objects = {object(ball({0, 0, 0}, 10, 1), outer, red), object(ball({0, 0, 0}, 5, 2), inner, blue)}};
    const Camera camera{.target = {0, 0, 0}, .view = {}, .height = 30};
    const Image image = render_scene(scene, camera, flat_shaded(31, 1));
    const double through = (1 - outer) * (1 - outer) * (1 - inner) * (1 - inner);
    EXPECT_NEAR(alpha(image, 15, 15), 1 - through, 1.0 / 255);
    // Front to back: red, blue, blue, red.
    const double reds = outer + (1 - outer) * (1 - inner) * (1 - inner) * outer, blues = (1 - outer) * (1 - (1 - inner) * (1 - inner));
    const double linear_red = reds / (1 - through), linear_blue = blues / (1 - through);
    const auto srgb = [](double l) { return 1.055 * std::pow(l, 1 / 2.4) - 0.055; };
    EXPECT_NEAR(image.at(15, 15)[0] / 255.0, srgb(linear_red), 1.5 / 255);
    EXPECT_NEAR(image.at(15, 15)[2] / 255.0, srgb(linear_blue), 1.5 / 255);
    EXPECT_NEAR(alpha(image, 7, 15), 1 - (1 - outer) * (1 - outer), 1.0 / 255) << "beside the inner shell";
}

TEST(Render, CutFacesShowWhatIsInside) {
    const Colour red{1, 0, 0}, blue{0, 0, 1};
    Scene scene{.objects = {object(ball({0, 0, 0}, 10, 1), 1, red), object(ball({0, 0, 0}, 5, 2), 1, blue)}};
    scene.removed = {{.normal = {0, -1, 0}, .offset = 0}};  // the half towards the eye
    const Camera camera{.target = {0, 0, 0}, .view = {}, .height = 30};
    const Image image = render_scene(scene, camera, flat_shaded(31, 1));
    EXPECT_EQ(image.at(15, 15)[2], 255) << "the inner ball's face";
    EXPECT_EQ(image.at(15, 15)[0], 0);
    EXPECT_EQ(image.at(8, 15)[0], 255) << "the outer ball's face";
    EXPECT_EQ(image.at(8, 15)[2], 0);
    EXPECT_EQ(image.at(2, 15)[3], 0);
    scene.removed.push_back({.normal = {1, 0, 0}, .offset = 0});  // now a quarter only
    EXPECT_EQ(render_scene(scene, camera, flat_shaded(31, 1)).at(13, 15)[0], 255) << "the outer ball is whole here";
}

TEST(Render, WhereObjectsTouchTheHigherIsovalueIsSeen) {
    const Colour red{1, 0, 0}, blue{0, 0, 1};
    const Scene scene{.objects = {object(box({0, 0, 0}, {9, 9, 9}, 1), 1, red), object(box({3, 0, 3}, {6, 5, 6}, 2), 1, blue)}};
    const Camera camera{.target = {4.5, 0, 4.5}, .view = {}, .height = 10};
    const Image image = render_scene(scene, camera, flat_shaded(50, 4));
    for (std::int64_t y = 20; y < 30; ++y) {
        for (std::int64_t x = 20; x < 30; ++x) ASSERT_EQ(image.at(x, y)[2], 255);
    }
    EXPECT_EQ(image.at(5, 25)[0], 255);
}

TEST(Render, TheSameBytesForAnyThreads) {
    Scene scene{
        .objects = {object(box({0, 0, 0}, {9, 9, 9}, 1), 0.4), object(box({3, 0, 3}, {6, 5, 6}, 2)), object(ball({2, 2, 7}, 2, 3))}};
    scene.removed = {{.normal = {1, 0, 0}, .offset = 5}, {.normal = {0, -1, 0}, .offset = -3}};
    RenderOptions options{.width = 90, .height = 70, .scale_bar = true, .legend = true};
    const View view = best_view(scene, {0, 0, 1}, with_threads(1));
    const Camera camera = fit_camera(scene, view, options);
    const Image one = render_scene(scene, camera, options, with_threads(1));
    for (const int threads : {2, 3}) {
        EXPECT_EQ(best_view(scene, {0, 0, 1}, with_threads(threads)).toward, view.toward);
        EXPECT_TRUE(render_scene(scene, camera, options, with_threads(threads)) == one) << threads;
    }
}

TEST(Render, BestViewSeesMost) {
    // A tall plate: its face is the best view, not its edge. The thing on it is on one side.
    const Scene scene{.objects = {object(box({0, 0, 0}, {10, 1, 10}, 1)), object(ball({5, -1, 5}, 2, 2))}};
    const View view = best_view(scene);
    EXPECT_LT(view.toward[1], -0.5);
    EXPECT_GT(view.up[2], 0.7);
    EXPECT_LT(best_view(scene, {0, 0, -1}).up[2], -0.7);
}

TEST(Render, ViewsTurnWithTheirAxis) {
    for (const Vec3& up : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0.6, 0, 0.8}}) {
        const View front = view_from(0, 0, up), side = view_from(90, 0, up), top = view_from(0, 90, up);
        for (int a = 0; a < 3; ++a) {
            EXPECT_NEAR(front.up[a], up[a], 1e-12);
            EXPECT_NEAR(top.toward[a], up[a], 1e-12);
        }
        const auto dot = [](const Vec3& u, const Vec3& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
        EXPECT_NEAR(dot(front.toward, up), 0, 1e-12);
        EXPECT_NEAR(dot(front.toward, side.toward), 0, 1e-12);
        EXPECT_NEAR(dot(side.toward, side.toward), 1, 1e-12);
    }
    EXPECT_NEAR(view_from(0, 0).toward[1], -1, 1e-12);
    EXPECT_NEAR(view_from(90, 0).toward[0], 1, 1e-12);
}

TEST(Render, ScaleBarsAreRoundAndTrue) {
    for (const double pixel : {1e-6, 0.031, 0.5, 1.0, 7.7, 12345.0}) {
        const ScaleBar bar = scale_bar(pixel, 640, "mm");
        EXPECT_NEAR(bar.pixels * pixel, bar.length, 1e-12 * bar.length);
        EXPECT_LE(bar.pixels, 160);
        EXPECT_GE(bar.pixels, 64);
        const double digit = bar.length / std::pow(10, std::floor(std::log10(bar.length) + 1e-9));
        EXPECT_TRUE(std::abs(digit - 1) < 1e-6 || std::abs(digit - 2) < 1e-6 || std::abs(digit - 5) < 1e-6) << digit;
    }
    EXPECT_EQ(scale_bar(0.5, 640, "mm").text, "50 mm");
}

TEST(Render, TheDrawnScaleBarIsAsLongAsTheThingBesideIt) {
    // A box of the bar's length: its silhouette is as wide as the bar between its ticks.
    const double height = 70;
    RenderOptions options = flat_shaded(400);
    const ScaleBar bar = scale_bar(height / 400, 400, "mm");
    Scene scene{.objects = {object(box({0, 0, 10}, {bar.length, 1, 12}, 1))}};
    const Camera camera{.target = {bar.length / 2, 0, 0}, .view = {.toward = {0, -1, 0}, .up = {0, 0, 1}}, .height = height};
    const auto width_of_row = [](const Image& image, std::int64_t y) {
        std::int64_t first = image.width, last = -1;
        for (std::int64_t x = 0; x < image.width; ++x) {
            if (image.at(x, y)[3] > 127) first = std::min(first, x), last = x;
        }
        return last - first + 1;
    };
    const std::int64_t thing = width_of_row(render_scene(scene, camera, options), 400 / 2 - static_cast<std::int64_t>(11 / (height / 400)));
    EXPECT_NEAR(static_cast<double>(thing), bar.pixels, 1);
    options.scale_bar = true;
    const Image image = render_scene(scene, camera, options);
    std::int64_t widest = 0;  // the bar's own row; its ends are the ticks, as thick as the line
    for (std::int64_t y = 360; y < 400; ++y) widest = std::max(widest, width_of_row(image, y));
    EXPECT_NEAR(static_cast<double>(widest), bar.pixels, 4);
}

TEST(Render, RefusesWhatCannotBeDrawn) {
    EXPECT_THROW(static_cast<void>(best_view({})), Error);
    Scene scene{.objects = {object(ball({0, 0, 0}, 1, 1, 8))}};
    const Camera camera{};
    EXPECT_THROW(static_cast<void>(render_scene(scene, camera, {.width = 0})), Error);
    EXPECT_THROW(static_cast<void>(render_scene(scene, camera, {.samples = 0})), Error);
    scene.objects[0].opacity = 0;
    EXPECT_THROW(static_cast<void>(render_scene(scene, camera)), Error);
    scene.objects[0] = as_points(ball({0, 0, 0}, 1, 1, 8), 0.5);
    scene.objects[0].opacity = 0.5;
    EXPECT_THROW(static_cast<void>(render_scene(scene, camera)), Error);
    scene.objects[0].opacity = 1;
    scene.objects[0].surface.normals.clear();
    EXPECT_THROW(static_cast<void>(render_scene(scene, camera)), Error);
    EXPECT_THROW(write_image("picture.bmp", Image(1, 1)), Error);
}

}  // namespace
}  // namespace isoatlas
