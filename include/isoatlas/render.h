// Render: pictures of surfaces and volumes without a display. Ray tracing on the processor; the same bytes for any number of threads.
//
//   Scene scene;
//   scene.objects.push_back({.surface = extract(volume, 100), .colour = palette(0)});
//   const Camera camera = fit_camera(scene, best_view(scene), {.width = 512, .height = 512});
//   write_image("bone.png", render_scene(scene, camera, {.width = 512, .height = 512}));
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/context.h"
#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Red, green, blue, opacity of every pixel, 8 bits each, sRGB, not premultiplied. Row 0 is the top one, x runs fastest.
struct Image {
    std::int64_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< 4 * width * height

    Image() = default;
    Image(std::int64_t columns, std::int64_t rows) : width(columns), height(rows), rgba(4 * columns * rows) {}
    [[nodiscard]] std::uint8_t* at(std::int64_t x, std::int64_t y) { return &rgba[4 * (x + width * y)]; }
    [[nodiscard]] const std::uint8_t* at(std::int64_t x, std::int64_t y) const { return &rgba[4 * (x + width * y)]; }
    bool operator==(const Image&) const = default;
};

/// sRGB, each 0..1.
struct Colour {
    double red = 0, green = 0, blue = 0;
    bool operator==(const Colour&) const = default;
};
/// Colours that people with any kind of colour vision tell apart (after Okabe and Ito, 2008), the first one that of bone; repeats after 7.
[[nodiscard]] Colour palette(std::int64_t i);

/// One thing to be drawn.
struct SceneObject {
    Surface surface;     ///< 3D, closed where it is cut away, with normals
    Colour colour{};     ///< see palette()
    double opacity = 1;  ///< (0, 1], of one sheet seen head-on; 1: nothing shines through
    std::string name{};  ///< for the legend; empty: not in it
};

/// Points x with dot(normal, x) > offset, in physical coordinates.
struct HalfSpace {
    Vec3 normal{};
    double offset = 0;
};

struct Scene {
    std::vector<SceneObject> objects;
    /// What lies in all of these half-spaces is cut away; the faces of the cut have the colour of the object they cut, the object with
    /// the highest isovalue where several contain a point. Empty: nothing is cut away.
    std::vector<HalfSpace> removed;
    std::string unit;  ///< of lengths, for the scale bar; empty: that of the first surface
};

enum class Projection : std::uint8_t { orthographic, perspective };

/// Where one looks from. `toward` is the unit vector from what is looked at to the eye, `up` a unit vector that is upwards in the picture.
struct View {
    Vec3 toward{0, -1, 0}, up{0, 0, 1};
};

/// An eye. The picture's vertical extent in the plane through `target` is `height`; pixels are square.
struct Camera {
    Projection projection = Projection::orthographic;
    Vec3 target{};
    View view{};
    double height = 1;    ///< physical
    double distance = 1;  ///< of the eye from the target; perspective only
};

enum class Background : std::uint8_t { light, dark, transparent };

struct RenderOptions {
    std::int64_t width = 768, height = 768;  ///< 1 to 16384
    Projection projection = Projection::orthographic;
    Background background = Background::light;
    int samples = 4;         ///< per pixel, 1 to 256
    bool shading = true;     ///< false: flat colours, no light and no shadow
    bool scale_bar = false;  ///< a bar of a round physical length; needs an orthographic camera
    bool legend = false;     ///< names of the objects with their colours
    double text_size = 0;    ///< height of a capital letter in pixels; 0: fits the picture
};

/// The view, of a fixed set, in which most of the objects is seen and least of it is hidden: largest viewpoint entropy (Vazquez et al.,
/// 2001) over pieces of the surfaces. Up is the head-foot axis of the space where there is one, else the last axis.
/// Throws Error{not_found} for a scene without triangles. Cost: 40 small pictures.
[[nodiscard]] View best_view(const Scene& scene, const Context& context = {});

/// A camera that shows all of the scene with a margin. Throws Error{not_found} for an empty scene.
[[nodiscard]] Camera fit_camera(const Scene& scene, const View& view, const RenderOptions& options = {});

/// Where a point appears, in pixels from the upper left corner of the picture (pixel centres at .5), and its depth towards the viewer.
[[nodiscard]] Vec3 project(const Camera& camera, const RenderOptions& options, const Vec3& point);

/// A length of 1, 2 or 5 times a power of ten that takes at most a quarter of the picture's width.
struct ScaleBar {
    double length;  ///< physical
    double pixels;
    std::string text;  ///< "20 mm"
};
/// pixel_size: physical size of a pixel.
[[nodiscard]] ScaleBar scale_bar(double pixel_size, std::int64_t width, const std::string& unit);

/// The picture. Throws Error: usage (sizes, opacity, a 2D surface), cancelled.
/// Cost: O(triangles log triangles) once, then rays: some ten per pixel and sample.
[[nodiscard]] Image render_scene(const Scene& scene, const Camera& camera, const RenderOptions& options = {}, const Context& context = {});

/// The bytes of a PNG file.
[[nodiscard]] std::vector<std::byte> encode_png(const Image& image);

/// Writes .png. Written to a temporary name and renamed. Throws Error: usage (unknown extension), resource.
void write_image(const std::string& path, const Image& image);

}  // namespace isoatlas
