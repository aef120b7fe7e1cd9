// Renders a scene: tiles of pixels in parallel, then denoising, composition and overlays.
#include <algorithm>
#include <cmath>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/phase.h"
#include "isoatlas/environment.h"
#include "render/film.h"
#include "render/overlay.h"
#include "render/scene_box.h"

namespace isoatlas {
namespace {

constexpr PhasePlan<2> kDrawPhases{{"prepare surfaces", "draw"}};
constexpr std::int64_t kTile = 16;
constexpr std::int64_t kMaxSide = 16384;

[[noreturn]] void refuse(const std::string& what, const std::string& expected, const std::string& next = "") {
    throw Error(ErrorKind::usage, {.what = what, .expected = expected, .next = next});
}

void check_points(const SceneObject& object) {
    if (object.surface.normals.size() != object.surface.points.size()) refuse("points without normals", "a normal for each point");
    if (object.opacity < 1)
        refuse("points cannot be transparent: where their discs overlap each would absorb", "opaque points",
               "draw them opaque, or a surface of triangles");
}

void check_optics(const SceneVolume& volume, const RenderOptions& options) {
    const Scattering& scattering = volume.scattering;
    const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
    if (volume.shadows && volume.optics != OpticalModel::absorption_emission)
        refuse("shadows belong to the shading of absorption and emission", "no shadows with another optical model",
               "draw it by single scattering, where matter casts shadows by itself");
    if (volume.optics == OpticalModel::emission && options.background == Background::transparent)
        refuse("emission adds to what is behind it, and has no opacity", "a light or a dark background", "draw it on a dark background");
    if (!within(scattering.albedo, 0, 1)) refuse("the albedo of matter is out of range", "0 to 1");
    if (!within(scattering.asymmetry, -0.99, 0.99)) refuse("the asymmetry of scattering is out of range", "-0.99 to 0.99");
    if (!within(scattering.light, 0, 1e6) || !within(scattering.sky, 0, 1e6)) refuse("a light is out of range", "0 to 1000000");
    if (scattering.max_events < 1) refuse("a path of light has no event", "1 or more");
    if (!std::isfinite(norm(scattering.to_light))) refuse("the direction to the lamp is not finite", "three finite numbers");
}

void check_options(const Scene& scene, const RenderOptions& options) {
    check_optics(scene.volume, options);
    if (options.width < 1 || options.height < 1 || options.width > kMaxSide || options.height > kMaxSide)
        refuse("a picture of " + std::to_string(options.width) + " x " + std::to_string(options.height) + " pixels", "1 to 16384 each");
    if (options.samples < 1 || options.samples > 256) refuse("the number of samples per pixel is out of range", "1 to 256");
    if (!(scene.volume.sample_distance >= 0.05 && scene.volume.sample_distance <= 16))
        refuse("the distance between samples of a ray is out of range", "0.05 to 16 times the smallest spacing");
    for (const SceneObject& object : scene.objects) {
        if (!(object.opacity > 0 && object.opacity <= 1)) refuse("the opacity of an object is out of range", "above 0, at most 1");
        if (!object.surface.segments.empty()) refuse("a curve of a 2D volume is not a surface", "surfaces of 3D volumes");
        if (object.point_radius > 0 && object.surface.triangles.empty()) check_points(object);
    }
}

/// Point s of n in a pixel: stratified, shifted by a number of the pixel.
Sample2 point_in_pixel(std::uint32_t seed, int s, int n) {
    if (n == 1) return {0.5, 0.5};
    return sample_2d(seed ^ 0x2545f491U, static_cast<std::uint32_t>(s));
}

/// Draws pixels of a film.
class Painter {
public:
    Painter(const Tracer& tracer, const Camera& camera, const CameraRays& rays, const Frame& frame, const RenderOptions& options)
        : tracer_(tracer),
          rays_(rays),
          frame_(frame),
          options_(options),
          behind_(2 * frame.radius + norm(minus(camera.target, frame.centre))) {}

    void paint_tile(std::int64_t tile, Film& film) const {
        const std::int64_t across = (film.width + kTile - 1) / kTile;
        const std::int64_t x0 = tile % across * kTile, y0 = tile / across * kTile;
        Workspace work;
        for (std::int64_t y = y0; y < std::min(film.height, y0 + kTile); ++y) {
            for (std::int64_t x = x0; x < std::min(film.width, x0 + kTile); ++x) {
                if (!tracer_.shows(x, y)) continue;
                const FilmSum sum = paint(x, y, work);
                film.pixels[x + film.width * y] = sum.mean();
                if (!film.surfaces.empty()) film.surfaces[x + film.width * y] = sum.mean_surface();
            }
        }
    }

private:
    [[nodiscard]] FilmSum paint(std::int64_t x, std::int64_t y, Workspace& work) const {
        const std::uint32_t seed = hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
        FilmSum sum;
        for (int s = 0; s < options_.samples; ++s) {
            const Sample2 at = point_in_pixel(seed, s, options_.samples);
            Ray ray = rays_.through(static_cast<double>(x) + at.u, static_cast<double>(y) + at.v, behind_);
            ray.origin = frame_.inside(ray.origin);
            sum.add(tracer_.trace(ray, seed, static_cast<std::uint32_t>(s), work));
        }
        return sum;
    }

    const Tracer& tracer_;
    const CameraRays& rays_;
    const Frame& frame_;
    const RenderOptions& options_;
    double behind_;  ///< physical distance of orthographic eyes from the target: outside of the scene
};

}  // namespace

Image blank_picture(const RenderOptions& options) {
    check_options({}, options);
    Image image = developed(Film(options.width, options.height), options.background, 1);
    RenderOptions words = options;
    words.scale_bar = false;
    draw_overlay({}, {}, words, image);
    return image;
}

Image render_scene(const Scene& scene, const Camera& camera, const RenderOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    check_options(scene, options);
    const SceneBox box = box_of(scene);
    const Frame frame{box.centre(), box.radius()};
    const CameraRays rays(camera, options.width, options.height);
    report(context, kDrawPhases["prepare surfaces"], 0);
    const Tracer tracer(scene, frame, rays, options.shading, context.threads);
    Film film(options.width, options.height, !scene.objects.empty());
    const Painter painter(tracer, camera, rays, frame, options);
    const auto tiles_of = [](std::int64_t pixels) { return (pixels + kTile - 1) / kTile; };
    const std::int64_t across = tiles_of(film.width), rows = tiles_of(film.height);
    constexpr std::int64_t kRowsAtOnce = 4;  // interval of polling the caller for cancellation
    for (std::int64_t row = 0; row < rows; row += kRowsAtOnce) {
        stop_if_cancelled(context);
        report(context, kDrawPhases["draw"], static_cast<double>(row) / static_cast<double>(rows));
        const std::int64_t count = std::min(kRowsAtOnce, rows - row) * across;
        for_each_block(context.threads, count, [&](std::int64_t tile) { painter.paint_tile(row * across + tile, film); });
    }
    smooth_light(film, rays.pixel_size() / frame.radius, context.threads);
    Image image = developed(film, options.background, context.threads);
    draw_overlay(scene, camera, options, image);
    return image;
}

}  // namespace isoatlas
