#include "catalogue/turntable.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "formats/common/base64.h"
#include "preview/coarse_surface.h"

namespace isoatlas {
namespace {

constexpr double kQuality = 80;

std::string webp_uri(Image image) {
    Animation still;
    still.frames.push_back(std::move(image));
    return "data:image/webp;base64," + base64(encode_webp(still, kQuality));
}

void put_frame(const Image& frame, std::int64_t i, Image& strip) {
    for (std::int64_t y = 0; y < frame.height; ++y) std::copy_n(frame.at(0, y), 4 * frame.width, strip.at(i * frame.width, y));
}

/// From where it is drawn: few triangles tell, and take less time to be looked at from all sides.
View view_of(const Surface& surface, const Context& context) {
    constexpr std::size_t kEnough = 20'000;
    Scene scene;
    scene.objects.push_back({.surface = coarse_surface(surface, kEnough)});
    if (scene.objects[0].surface.triangles.empty()) scene.objects[0].surface = surface;
    return best_view(scene, {0, 0, 1}, context);
}

}  // namespace

Turntable draw_turntable(Surface surface, const Colour& colour, const PageOptions& options, const Context& context) {
    Turntable result;
    if (surface.triangles.empty()) return result;
    const View best = view_of(surface, context);
    Scene scene;
    scene.objects.push_back({.surface = std::move(surface), .colour = colour});
    const RenderOptions picture{
        .width = options.picture_size, .height = options.picture_size, .background = Background::transparent, .samples = 3};
    std::vector<Camera> cameras;
    for (std::int64_t i = 0; i < options.frames; ++i) {
        const double degrees = 360 * static_cast<double>(i) / static_cast<double>(options.frames);
        cameras.push_back(fit_camera(scene, rotated(best, best.up, degrees), picture));
    }
    const Camera& widest =
        *std::max_element(cameras.begin(), cameras.end(), [](const Camera& p, const Camera& q) { return p.height < q.height; });
    Image strip(options.frames * options.picture_size, options.picture_size);
    const double height = widest.height;
    for (std::int64_t i = 0; i < options.frames; ++i) {
        cameras[i].height = height;
        put_frame(render_scene(scene, cameras[i], picture, context), i, strip);
    }
    return {webp_uri(std::move(strip)), options.frames, options.picture_size};
}

Turntable draw_still(const Volume& volume, double tau, const Colour& colour, const PageOptions& options, const Context& context) {
    const Image slice = slice_picture(volume, {.contours = {{tau, colour}}, .side = options.picture_size}, context).picture;
    Image square(options.picture_size, options.picture_size);  // transparent outside the slice
    const std::int64_t left = (square.width - slice.width) / 2, top = (square.height - slice.height) / 2;
    for (std::int64_t y = 0; y < slice.height; ++y) std::copy_n(slice.at(0, y), 4 * slice.width, square.at(left, top + y));
    return {webp_uri(std::move(square)), 1, options.picture_size};
}

}  // namespace isoatlas
