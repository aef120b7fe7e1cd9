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
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/context.h"
#include "isoatlas/image.h"
#include "isoatlas/objects.h"
#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// sRGB, each 0..1.
struct Colour {
    double red = 0, green = 0, blue = 0;
    bool operator==(const Colour&) const = default;
};
/// Colours distinguishable by any kind of colour vision (after Okabe and Ito, 2008), the first one that of bone; repeats after 7.
[[nodiscard]] Colour palette(std::int64_t i);
/// Of an object or a cavity by its number in the table, from 1: on the page, in the viewer, in label volumes and files of several surfaces.
[[nodiscard]] Colour colour_of_object(std::int64_t number);
[[nodiscard]] Colour colour_of_cavity(std::int64_t number);

/// One thing to be drawn.
struct SceneObject {
    Surface surface;     ///< 3D, closed where it is cut away, with normals
    Colour colour{};     ///< see palette()
    double opacity = 1;  ///< (0, 1], of one sheet seen head-on; 1: nothing shines through
    std::string name{};  ///< for the legend; empty: not in it
    /// > 0, physical: the points of a surface without triangles are drawn as discs of this radius, each perpendicular to its normal (as
    /// those of Dividing Cubes: docs/methods.md). Opaque only, and not closed where they are cut away.
    double point_radius = 0;
};

/// Points x with dot(normal, x) > offset, in physical coordinates.
struct HalfSpace {
    Vec3 normal{};
    double offset = 0;
};

/// A picture in space: its upper left corner, and the vectors to its right and its lower end. It is neither clipped nor shaded.
struct SceneSlice {
    Image picture;
    Vec3 corner{}, across{}, down{};
};

/// Tent function of opacity: emission and absorption between two values. Extinction per unit of length rises linearly from 0 at low and at
/// high to `density`, over `ramp` of the range at each end, 0 (a box) to 0.5 (a triangle).
struct OpacityTent {
    double low = 0, high = 0;  ///< stored values
    Colour colour{};
    double density = 0;
    double ramp = 0.5;
    double tau = 0;      ///< isovalue of the object that it shows; only for the caller
    std::string name{};  ///< for the legend; empty: not in it
};

/// The same with an extinction that is linear between points: {stored value, extinction per unit of length}, values not falling. Two points
/// at one value: it jumps. Nothing before the first and behind the last point.
struct TransferCurve {
    std::vector<std::array<double, 2>> points{};
    Colour colour{};
    std::string name{};             ///< for the legend; empty: not in it
    std::vector<Colour> colours{};  ///< one for each point, and extinction times linear light is linear between points (Wittenbrink,
                                    ///< Malzbender and Goss, 1998); empty: `colour` everywhere
};
/// Extinction per unit of length of matter that absorbs `opacity`, [0, 1), of the light over `length`.
[[nodiscard]] double extinction_of(double opacity, double length);

/// What matter does to light (Max, Optical models for direct volume rendering, 1995; dissertation, section 2.1). s is the extinction of the
/// transfer function and C its colour; T(a, b) = exp(-integral of s from a to b) is what passes.
enum class OpticalModel : std::uint8_t {
    absorption,           ///< takes T from the light behind it, and is black
    emission,             ///< adds the integral of s C and takes nothing; not on a transparent background
    absorption_emission,  ///< the integral of s C T(eye, point), shaded by the lights of the camera where options say so
    single_scattering,    ///< as before, C times the light that comes from a lamp through the matter, and is scattered once
    multiple_scattering   ///< light is scattered any number of times: path tracing
};

/// Of the scattering models; they know no shading by gradients.
struct Scattering {
    double albedo = 1;      ///< scattered part of the light that matter takes, 0 to 1; times its colour
    double asymmetry = 0;   ///< mean cosine of the angle by which light turns (Henyey and Greenstein, 1941), -0.99 to 0.99; 0: isotropic
    Vec3 to_light{};        ///< direction to the lamp, which is infinitely far; zero: the key light of the camera
    double light = 1;       ///< irradiance of the lamp divided by 4 pi: a thin isotropic white medium looks as if it had emission alone
    double sky = 0;         ///< radiance from all directions; multiple scattering only
    int max_events = 1000;  ///< a path ends after so many; multiple scattering only
};

/// Volume rendering of a participating medium, composited front to back together with surfaces and slices. Tents and curves add up.
struct SceneVolume {
    const Volume* volume = nullptr;  ///< must live as long as the picture is drawn; null: none. No rectilinear grids
    std::vector<OpacityTent> tents{};
    std::vector<TransferCurve> curves{};
    std::optional<std::array<double, 2>> range{};  ///< lowest and highest sample; unset: computed
    bool shadows = false;                          ///< of the medium and of opaque surfaces, in the shading of absorption_emission
    double sample_distance = 1;                    ///< between two samples along a ray, in the smallest spacing; 0.05 to 16
    OpticalModel optics = OpticalModel::absorption_emission;
    Scattering scattering{};  ///< opaque surfaces cast shadows on what scatters, and throw no light back
};

struct Scene {
    std::vector<SceneObject> objects{};
    /// What lies in all of these half-spaces is cut away; the faces of the cut have the colour of the object they cut, the object with
    /// the highest isovalue where several contain a point. Empty: nothing is cut away.
    std::vector<HalfSpace> removed{};
    std::vector<SceneSlice> slices{};
    SceneVolume volume{};
    std::string unit{};  ///< of lengths, for the scale bar; empty: that of the first surface
};

enum class Projection : std::uint8_t { orthographic, perspective };

/// A view direction. `toward` is the unit vector from the target to the camera, `up` a unit vector that is upwards in the picture.
struct View {
    Vec3 toward{0, -1, 0}, up{0, 0, 1};
};

/// The picture's vertical extent in the plane through `target` is `height`; pixels are square.
struct Camera {
    Projection projection = Projection::orthographic;
    Vec3 target{};
    View view{};
    double height = 1;    ///< physical
    double distance = 1;  ///< of the camera from the target; perspective only
};

enum class Background : std::uint8_t { light, dark, transparent };

struct RenderOptions {
    std::int64_t width = 768, height = 768;  ///< 1 to 16384
    Projection projection = Projection::orthographic;
    Background background = Background::light;
    int samples = 4;                     ///< per pixel, 1 to 256
    bool shading = true;                 ///< false: flat colours, no light and no shadow
    bool scale_bar = false;              ///< a bar of a round physical length; needs an orthographic camera
    bool legend = false;                 ///< names of the objects with their colours
    std::vector<std::string> caption{};  ///< lines in the lower left corner
    double text_size = 0;                ///< height of a capital letter in pixels; 0: fits the picture
};

/// The view, of a fixed set, in which most of the objects is seen and least of it is hidden: largest viewpoint entropy (Vazquez et al.,
/// 2001) over pieces of the surfaces. up: what is upwards in the picture; the default is the head-foot axis of all spaces that have one.
/// Throws Error{not_found} for a scene without triangles. Cost: 36 small pictures.
[[nodiscard]] View best_view(const Scene& scene, const Vec3& up = {0, 0, 1}, const Context& context = {});

/// Angles in degrees: 0, 0 is the front, which is at -y when z is up (in LPS: in front of the face), `around` goes to the right, `above`
/// up. Other axes: the space turned the shortest way so that z becomes `up`; for -z half around y.
[[nodiscard]] View view_from(double around, double above, const Vec3& up = {0, 0, 1});

/// A camera that shows all of the scene with a margin. Throws Error{not_found} for an empty scene.
[[nodiscard]] Camera fit_camera(const Scene& scene, const View& view, const RenderOptions& options = {});

/// A camera that shows all of the scene however it is rotated around the axis `up` through its middle.
[[nodiscard]] Camera fit_turntable(const Scene& scene, const View& view, const Vec3& up, const RenderOptions& options = {});
/// The view after a rotation of the camera around an axis, counter-clockwise seen from its tip.
[[nodiscard]] View rotated(const View& view, const Vec3& axis, double degrees);

/// Where a point appears, in pixels from the upper left corner of the picture (pixel centres at .5), and its depth towards the viewer.
[[nodiscard]] Vec3 project(const Camera& camera, const RenderOptions& options, const Vec3& point);

/// A length of 1, 2 or 5 times a power of ten that takes at most a quarter of the picture's width.
struct ScaleBar {
    double length = 0;  ///< physical
    double pixels = 0;
    std::string text;  ///< "20 mm"
};
/// pixel_size: physical size of a pixel.
[[nodiscard]] ScaleBar scale_bar(double pixel_size, std::int64_t width, const std::string& unit);

/// The picture. Throws Error: usage (sizes, opacity, sample distance, a 2D surface, points without normals or transparent, numbers of a
/// scattering model), cancelled.
/// Cost: O(triangles log triangles) once, then rays: some ten per pixel and sample. Single scattering: a ray to the lamp for every sample
/// of a ray; multiple scattering: two more for every event of a path.
[[nodiscard]] Image render_scene(const Scene& scene, const Camera& camera, const RenderOptions& options = {}, const Context& context = {});

struct SliceContour {
    double tau = 0;  ///< stored value
    Colour colour{};
};

struct SliceOptions {
    int axis = 2;                 ///< 0..2: what the slice is perpendicular to
    std::int64_t index = 0;       ///< of the samples along that axis
    double black = 0, white = 0;  ///< stored values of the darkest and the brightest grey (negated samples: the other way round); equal:
                                  ///< lowest and highest sample
    std::vector<SliceContour> contours{};
    std::int64_t side = 512;  ///< pixels of the longer side, 16 to 16384
};

/// A slice in grey, in its true proportions, with our contours (those of the 2D volume that the slice is) drawn over it. Seen along z: x to
/// the right, y down; along y: x to the right, z up; along x: y to the right, z up. Placed where it lies in space.
/// Throws Error: usage (axis, index, side). Cost: O(slice + pixels).
[[nodiscard]] SceneSlice slice_picture(const Volume& volume, const SliceOptions& options, const Context& context = {});

/// Tents for the objects of a table at their best isovalues, in ascending order, one colour each (from palette(first_colour) on), outer
/// objects thinner: a skin at the isovalue, and a thin body up to where another object, another recommended isovalue of its own or its top
/// comes; the last one is solid. Background (is_background()) only if there is nothing else. range: lowest and highest sample.
[[nodiscard]] std::vector<OpacityTent> propose_transfer(const ObjectTable& table, const VolumeInfo& info, std::array<double, 2> range,
                                                        std::int64_t first_colour = 0);

/// Intervals of values that may be visible, unordered; they may overlap. volume.range must be given.
[[nodiscard]] std::vector<std::array<double, 2>> visible_values(const SceneVolume& volume);

/// A material of a mixture. Its stored values have a normal distribution.
struct Material {
    std::string name;
    double mean = 0, sigma = 1;  ///< stored values; sigma > 0
    Colour colour{};
    double density = 0;  ///< extinction per unit of length where there is nothing else; 0: invisible
};
/// The fraction of each material at a place of some value, sum 1: P_i / (P_1 + ... + P_n), P_i the probability of the value in material i
/// (Drebin, Carpenter, Hanrahan: Volume rendering, 1988). Throws Error{usage} for a sigma that is not positive.
[[nodiscard]] std::vector<double> material_percentages(std::span<const Material> materials, double value);
/// The extinction of each material, by its percentages. range: lowest and highest sample. Throws as material_percentages.
[[nodiscard]] std::vector<TransferCurve> material_transfer(std::span<const Material> materials, std::array<double, 2> range);

/// A picture with nothing in it but its caption.
[[nodiscard]] Image blank_picture(const RenderOptions& options);

}  // namespace isoatlas
