#include "options/options.h"

namespace isoatlas::cli {
namespace {

template <class T>
CLI::Option* add_word_or_number(CLI::App& app, const char* name, T& value, const char* meaning) {
    if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, std::vector<std::string>>) {
        return app.add_option(name, value, meaning);
    } else {
        return add_number(app, name, value, meaning);
    }
}

}  // namespace

void add_picture(CLI::App& app, Arguments& arguments, PictureWords& words) {
    const auto add = [&](const char* name, auto& value, const char* meaning, const char* type) {
        return add_word_or_number(app, name, value, meaning)->type_name(type);
    };
    add("--tau,--isovalue,--threshold", words.taus, "Surface of everything at these isovalues (calibrated)", "T");
    add("--object", words.objects, "Objects (2, v81275, a name) and cavities (c3), each at an isovalue; default: its best one", "REF[@T]");
    add("--contour", words.contours, "Contours: cavities (c3), or ids of `objects --tau`, each at an isovalue", "REF[@T]");
    add("--cavities", words.cavities, "Only the walls of the cavities of these objects, each at an isovalue", "REF[@T]");
    add("--top", arguments.top, "The first N objects of the table, each at its best isovalue (1)", "N")->check(in_range(1, 1000));
    add("--opacity", words.opacities, "Opacity of each surface, 0 to 1; default: surfaces that occlude others are transparent", "P");
    add("--colour", words.colours, "Colour of each surface, #RRGGBB", "C");
    add("--cut", words.cut, "Cut away: octant (nearest to the eye), half, or where all hold: x>12.5,0.6y-0.8z<3 (physical)", "WHAT");
    add("--slice", words.slices, "Also slices, in grey with the contours of the isovalues: x, y or z = index of the slice", "z=40");
    app.add_flag("--flat", arguments.picture.flat, "The (first) slice alone, as a 2D image");
    app.add_flag("--volume", arguments.picture.volume, "Also volume rendering, one colour for each object of the table");
    add("--material", words.materials, "Volume rendering of materials: name, mean, standard deviation, colour, opacity of a voxel (0.1)",
        "NAME:M:S:C[:P]");
    add("--transfer", words.curves, "Volume rendering by an opacity curve: values, opacities of a voxel, colours; several add up",
        "VALUE:P:C,...");
    app.add_flag("--shadows", arguments.picture.shadows, "Shadows in the volume rendering (with --volume)");
    add("--optics", words.optics, "Volume rendering: absorption, emission, absorption-emission, single-scattering or multiple-scattering",
        "MODEL");
    add("--albedo", words.albedo, "Scattering: the part of the light that matter scatters, times its colour (1)", "A")
        ->check(in_range(0.0, 1.0));
    add("--asymmetry", words.asymmetry, "Scattering: mean cosine of the angle by which light turns (0: in all directions)", "G")
        ->check(in_range(-0.99, 0.99));
    add("--light", words.light, "Scattering: direction to the light: an axis or X,Y,Z; default: from above left of the camera", "AXIS");
    add("--sky", words.sky, "Multiple scattering: light from all directions beside the directed one (0)", "L")
        ->check(in_range(0.0, 1000.0));
    add("--sample-distance", arguments.picture.sample_distance,
        "Volume rendering: distance of the samples along a ray, in voxels (1): longer is faster, and misses what is thin", "D")
        ->check(in_range(0.05, 16.0));
    add("--points", arguments.picture.points, "Surfaces as points by Dividing Cubes: N small cubes along each axis of a cell", "N")
        ->check(in_range(1, kMaxDivisions));
    add("--view", words.view, "auto, front, back, left, right, top, bottom, or angles AROUND,ABOVE in degrees", "FROM");
    add("--up", words.up, "Up direction of the picture: x, y, z, -x, -y, -z or X,Y,Z", "AXIS");
    add("--size", words.size, "Pixels: 768x768", "WxH");
    add("--background", words.background, "light, dark or transparent", "light|dark|transparent");
    add("--samples", arguments.picture.samples, "Samples per pixel (4): more is smoother and slower", "N")->check(in_range(1, 256));
    app.add_flag("--perspective", arguments.picture.perspective, "Perspective projection, without a scale bar");
    app.add_flag("--plain", arguments.picture.plain, "No scale bar and no legend");
}

void add_camera(CLI::App& app, PictureWords& words) {
    const auto add = [&](const char* name, auto& value, const char* meaning, const char* type) {
        return add_word_or_number(app, name, value, meaning)->type_name(type);
    };
    add("--eye", words.eye, "Position of the camera, physical, instead of --view; with --target", "X,Y,Z")->excludes("--view");
    add("--target", words.target, "Point in the middle of the picture, physical", "X,Y,Z");
    add("--height", words.height, "Height of the picture at the target, physical; default: a field of view of 30 degrees", "H")
        ->check(in_range(1e-300, 1e300));
}

void add_animation(CLI::App& app, Arguments& arguments) {
    AnimationArguments& animation = arguments.picture.animation;
    add_number(app, "--from", animation.from, "First isovalue of an evolution; without --from and --to: a turntable")->type_name("A");
    add_number(app, "--to", animation.to, "Last isovalue of an evolution")->type_name("B");
    add_number(app, "--steps", animation.steps, "Number of frames, or of surfaces (36)")
        ->check(in_range(std::int64_t{1}, std::int64_t{10000}))
        ->type_name("N");
    add_number(app, "--fps", animation.frames_per_second, "Frames per second (12)")->check(in_range(0.1, 100.0))->type_name("F");
}

}  // namespace isoatlas::cli
