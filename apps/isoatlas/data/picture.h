// What a picture shows, and how: the options of `render` and `animate`.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "options/object_reference.h"

namespace isoatlas::cli {

/// As typed.
struct PictureWords {
    std::vector<double> taus, opacities;
    std::vector<std::string> objects, contours, cavities, colours, slices, materials, curves;
    std::string cut, view = "auto", up = "z", size = "768x768", background = "light";
    std::string eye, target;
    std::string optics = "absorption-emission", light;
    std::optional<double> albedo, asymmetry, sky;
    double height = 0;  ///< 0: not given
};

/// Part of an object: its whole surface, one contour, or the walls of its cavities.
enum class ShownPart : std::uint8_t { object, contour, cavities };

/// --object, --contour, --cavities
struct ShownObject {
    ObjectReference reference;
    ShownPart part = ShownPart::object;
};

inline constexpr double kHalfAngle = kFieldOfView / 2;  ///< of a picture, without --height

/// --eye, --target, --height
struct ShownCamera {
    Vec3 eye{}, target{};
    double height = 0;  ///< of the picture at the target, physical
};

/// --slice z=40
struct ShownSlice {
    int axis = 2;
    std::int64_t index = 0;
};

/// --material fat:80:12:#E0C040:0.1
struct ShownMaterial {
    std::string name;
    double mean = 0, sigma = 0;  ///< calibrated
    Colour colour{};
    double opacity = 0;  ///< of a voxel
};

/// --transfer 300:0:#F0E8D0,400:0.3,1500:0.5
struct ShownCurve {
    struct Point {
        double value = 0;    ///< calibrated
        double opacity = 0;  ///< of a voxel
        Colour colour{};
    };
    std::vector<Point> points;  ///< at least two, values not falling
};

enum class CutShape : std::uint8_t { none, octant, half, planes };

struct AnimationArguments {
    std::optional<double> from, to;  ///< calibrated; none: a turntable
    std::int64_t steps = 36;
    double frames_per_second = 12;
    std::string picture_option{};  ///< the first typed option that shapes pictures alone
};

struct PictureArguments {
    std::vector<double> taus;  ///< calibrated
    std::vector<ShownObject> objects;
    std::vector<double> opacities;
    std::vector<Colour> colours;
    CutShape cut = CutShape::none;
    std::vector<HalfSpace> planes;  ///< of CutShape::planes
    Vec3 up{0, 0, 1};
    std::optional<View> view;           ///< none: the best one
    std::optional<ShownCamera> camera;  ///< instead of the view
    std::int64_t width = 768, height = 768;
    Background background = Background::light;
    int samples = 0;  ///< 0: not given
    std::vector<ShownSlice> slices;
    std::vector<ShownMaterial> materials;
    std::vector<ShownCurve> curves;
    AnimationArguments animation;
    bool perspective = false, plain = false;
    bool volume = false, shadows = false, flat = false;
    double sample_distance = 1;  ///< of volume rendering, in voxels
    int points = 0;              ///< divisions of Dividing Cubes; 0: surfaces are triangles
    OpticalModel optics = OpticalModel::absorption_emission;
    Scattering scattering;
};

/// Throws Error{usage} that names the option and its valid values.
void convert_picture(const PictureWords& words, PictureArguments& picture);

/// An axis such as -x, or any direction as three numbers; of length 1. Throws Error{usage} that names the option.
[[nodiscard]] Vec3 direction_of(const std::string& option, const std::string& word);
/// --optics, --albedo, --asymmetry, --light, --sky, as convert_picture(); after the rest.
void convert_optics(const PictureWords& words, PictureArguments& picture);
[[nodiscard]] std::string_view optics_name(OpticalModel model);

[[nodiscard]] RenderOptions options_of_picture(const PictureArguments& picture);
/// Camera of --eye, --target and --height. Throws Error{usage} when --eye or --target is missing.
[[nodiscard]] std::optional<ShownCamera> shown_camera(const PictureWords& words);
[[nodiscard]] Camera camera_of(const ShownCamera& shown, const PictureArguments& picture);
/// "x>12.5" or "0.6x-0.8z>3": the removed half-space; `all`: the whole option as typed.
[[nodiscard]] HalfSpace half_space(const std::string& word, const std::string& all);
/// The unit of length of the file, for the scale bar.
[[nodiscard]] std::string length_unit(const VolumeInfo& info);

/// Does the picture show isovalues, and not the labels of a label volume?
[[nodiscard]] bool shows_isovalues(const PictureArguments& picture);

/// The scene of the arguments, without the cut. Throws Error: usage, not_found.
class Sides;
class Source;
struct Arguments;
[[nodiscard]] Scene scene_of(const Arguments& arguments, Sides& sides);
/// The transfer function of --volume, --material and --transfer, without the samples. first_colour: in the palette.
[[nodiscard]] SceneVolume matter_of(const Arguments& arguments, Source& source, std::size_t first_colour);
/// The part that --cut removes, seen from `view`; octants and halves are those of the volume.
[[nodiscard]] std::vector<HalfSpace> removed_part(const PictureArguments& picture, const VolumeInfo& info, const View& view);

}  // namespace isoatlas::cli
