// Builds the scene of the options: surfaces, colours, clipped part.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/label_directory.h"
#include "data/picture.h"
#include "data/sides.h"

namespace isoatlas::cli {
namespace {

constexpr double kGlass = 0.28;  // opacity of what would hide others

[[noreturn]] void nothing_there(const Arguments& arguments, const std::string& what) {
    throw Error(ErrorKind::not_found, {.file = arguments.file,
                                       .what = what,
                                       .next = "isoatlas objects " + shell_word(arguments.file) + " lists objects and their isovalues"});
}

/// A surface to be extracted and drawn.
struct Wanted {
    double tau = 0;  ///< stored
    std::vector<std::int64_t> objects{};
    std::string name{};
    std::vector<std::int64_t> contours{};
    ShellChoice shell = ShellChoice::all;
    Polarity polarity = Polarity::high;
    std::optional<std::int64_t> label{};  ///< of a label volume; then nothing of the above but the name
    Colour own{};                         ///< of the label
};

Wanted wanted_object(const ChosenObject& object, ShownPart part = ShownPart::object) {
    Wanted wanted{.tau = object.tau, .objects = {object.voxel}, .name = fmt::format("{}  at {}", title_of(object), object.tau_text)};
    wanted.polarity = object.polarity;
    if (object.is_contour) wanted.objects.clear(), wanted.contours = {object.voxel};
    if (part == ShownPart::cavities) wanted.name = "cavities of " + wanted.name, wanted.shell = ShellChoice::inner;
    return wanted;
}

/// As typed: objects, contours, cavities of objects.
void add_shown(const Arguments& arguments, Sides& sides, std::vector<Wanted>& wanted) {
    const auto of_part = [&](ShownPart part) {
        std::vector<ObjectReference> references;
        for (const ShownObject& shown : arguments.picture.objects) {
            if (shown.part == part) references.push_back(shown.reference);
        }
        return references;
    };
    for (const ChosenObject& object : sides.find(of_part(ShownPart::object))) wanted.push_back(wanted_object(object));
    for (const ChosenObject& contour : sides.find_contours(of_part(ShownPart::contour))) wanted.push_back(wanted_object(contour));
    for (const ChosenObject& object : sides.find(of_part(ShownPart::cavities))) {
        if (object.is_contour)
            throw Error(ErrorKind::usage, {.what = title_of(object) + " is a cavity, and not the object around one",
                                           .next = "draw it as an object: " + reference_of(object, true)});
        wanted.push_back(wanted_object(object, ShownPart::cavities));
    }
}

/// As typed, or all labels.
std::vector<Wanted> wanted_labels(const Arguments& arguments, Source& source) {
    LabelDirectory directory(arguments, source);
    std::vector<ObjectReference> references;
    for (const ShownObject& shown : arguments.picture.objects) references.push_back(shown.reference);
    std::vector<Wanted> wanted;
    for (const std::int64_t label : directory.find(references, arguments.top)) {
        const auto [red, green, blue] = directory.colour_of(label);
        wanted.push_back({.name = directory.title_of(label), .label = label, .own = Colour{red / 255.0, green / 255.0, blue / 255.0}});
    }
    return wanted;
}

Surface surface_of(Sides& sides, const Wanted& wanted) {
    Source& source = sides.source(wanted.polarity);
    SurfaceOptions options;
    options.objects = wanted.objects;
    options.contours = wanted.contours;
    options.shell = wanted.shell;
    options.ids = false;
    if (!wanted.label) return source.extract(wanted.tau, options);
    return extract_label(source.volume(), *wanted.label, {.interpolant = source.interpolant(), .surface = options}, source.context());
}

/// What Dividing Cubes makes of a surface; discs that leave no gaps.
SceneObject points_of(const Arguments& arguments, Sides& sides, const Wanted& wanted) {
    if (wanted.label)
        throw Error(ErrorKind::usage, {.where = "--points",
                                       .what = "a label has no samples between which Dividing Cubes could interpolate",
                                       .next = "omit --points"});
    Source& source = sides.source(wanted.polarity);
    const int divisions = arguments.picture.points;
    SceneObject object;
    object.surface = surface_of(sides, wanted);
    const double tau = object.surface.tau;
    PointCloud cloud = points_of_surface(source.volume({.values = {{tau, tau}}}), object.surface, divisions, source.context());
    object.name = fmt::format("{}, {} points", wanted.name, count_text(std::ssize(cloud.points)));
    object.surface.points = std::move(cloud.points), object.surface.normals = std::move(cloud.normals);
    object.surface.triangles = {};
    object.point_radius = disc_radius(source.info(), divisions);
    return object;
}

std::vector<Wanted> wanted_of(const Arguments& arguments, Sides& sides) {
    const bool of_labels = arguments.verb == "render" && arguments.inputs.are_labels && !shows_isovalues(arguments.picture);
    if (of_labels) return wanted_labels(arguments, sides.main());
    std::vector<Wanted> wanted;
    for (const double tau : arguments.picture.taus) {
        const double stored = sides.main().stored(tau);
        wanted.push_back({stored, {}, fmt::format("isovalue {}", tau)});
        wanted.back().polarity = sides.polarity();
    }
    add_shown(arguments, sides, wanted);
    const bool other_things = arguments.picture.volume || !arguments.picture.slices.empty();
    if ((!wanted.empty() || other_things) && arguments.top == 0) return wanted;
    const std::vector<ChosenObject> first = sides.first(std::max<std::int64_t>(1, arguments.top));
    if (first.empty() && wanted.empty()) nothing_there(arguments, "nothing in this volume rises above the noise");
    for (const ChosenObject& object : first) wanted.push_back(wanted_object(object));
    return wanted;
}

struct Box {
    Vec3 low, high;
};

Box box_of(const Surface& surface) {
    Box box{surface.points[0], surface.points[0]};
    for (const Vec3& p : surface.points) {
        for (std::size_t a = 0; a < 3; ++a) box.low[a] = std::min(box.low[a], p[a]), box.high[a] = std::max(box.high[a], p[a]);
    }
    return box;
}

/// Does the box of a higher isovalue lie in that of a lower one? Then the lower surface occludes the higher one. Of different polarities
/// any box in another one.
bool hides(const SceneObject& outer, const SceneObject& inner) {
    const bool are_alike = outer.surface.polarity == inner.surface.polarity;
    if (are_alike && outer.surface.tau >= inner.surface.tau) return false;
    const Box a = box_of(outer.surface), b = box_of(inner.surface);
    if (!are_alike && a.low == b.low && a.high == b.high) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        const double slack = 1e-9 * (a.high[i] - a.low[i]);
        if (b.low[i] < a.low[i] - slack || b.high[i] > a.high[i] + slack) return false;
    }
    return true;
}

void choose_opacities(const PictureArguments& picture, std::vector<SceneObject>& objects) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const bool cut = picture.cut != CutShape::none;
        const bool in_the_way = std::any_of(objects.begin(), objects.end(), [&](const SceneObject& o) { return hides(objects[i], o); });
        const bool is_glass = in_the_way && !cut && picture.points == 0;
        objects[i].opacity = i < picture.opacities.size() ? picture.opacities[i] : is_glass ? kGlass : 1;
    }
}

/// The longer side of a slice that fits a picture.
std::int64_t slice_side(const VolumeInfo& info, int axis, std::int64_t width, std::int64_t height) {
    const auto length = [&](int a) { return info.geometry.spacing[a] * static_cast<double>(info.extent.size[a]); };
    const double across = length(axis == 0 ? 1 : 0), down = length(axis == 2 ? 1 : 2);
    const double pixels = std::min(static_cast<double>(width) / across, static_cast<double>(height) / down);
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(pixels * std::max(across, down)), 16, 16384);
}

SampleBox box_of_slice(const Extent& extent, const ShownSlice& slice) {
    SampleBox box{{0, 0, 0}, extent.size};
    box.begin[static_cast<std::size_t>(slice.axis)] = slice.index;
    box.end[static_cast<std::size_t>(slice.axis)] = slice.index + 1;
    return box;
}

void add_slices(const Arguments& arguments, Source& source, const Volume& volume, Scene& scene) {
    const PictureArguments& picture = arguments.picture;
    const ValueRange range = source.range();
    const Scale scale(source.info());
    for (const ShownSlice& shown : picture.slices) {
        SliceOptions options{.axis = shown.axis, .index = shown.index, .black = range.low, .white = range.high};
        options.side =
            picture.flat ? slice_side(source.info(), shown.axis, picture.width, picture.height) : std::max(picture.width, picture.height);
        for (const SceneObject& object : scene.objects) {
            const bool is_same = object.surface.polarity == polarity_of(source.info());
            options.contours.push_back({is_same ? object.surface.tau : scale.stored(object.surface.reported_tau), object.colour});
        }
        scene.slices.push_back(slice_picture(volume, options, source.context()));
    }
}

/// Slices and volume rendering: these need the samples.
void add_samples(const Arguments& arguments, Source& source, Scene& scene) {
    const PictureArguments& picture = arguments.picture;
    if (picture.slices.empty() && !picture.volume) return;
    SceneVolume matter = matter_of(arguments, source, scene.objects.size());
    SamplesWanted wanted{.values = visible_values(matter)};
    for (const ShownSlice& slice : picture.slices) wanted.boxes.push_back(box_of_slice(source.info().extent, slice));
    const Volume& volume = source.volume(wanted);
    add_slices(arguments, source, volume, scene);
    if (!picture.volume) return;
    matter.volume = &volume;
    scene.volume = std::move(matter);
}

}  // namespace

bool shows_isovalues(const PictureArguments& picture) {
    const auto is_no_label = [](const ShownObject& shown) {
        const bool is_label = shown.reference.kind == ObjectReference::Kind::number || shown.reference.kind == ObjectReference::Kind::name;
        return shown.part != ShownPart::object || shown.reference.tau || !is_label;
    };
    return !picture.taus.empty() || picture.volume || !picture.slices.empty() || std::ranges::any_of(picture.objects, is_no_label);
}

RenderOptions options_of_picture(const PictureArguments& picture) {
    RenderOptions options{.width = picture.width, .height = picture.height};
    options.projection = picture.perspective ? Projection::perspective : Projection::orthographic;
    options.background = picture.background;
    const bool is_noisy = picture.volume && picture.optics == OpticalModel::multiple_scattering;
    const int usual = is_noisy ? 8 : picture.volume ? 2 : 4;  // volume rendering has no edges
    options.samples = picture.samples > 0 ? picture.samples : usual;
    options.scale_bar = options.legend = !picture.plain;
    return options;
}

std::string length_unit(const VolumeInfo& info) { return length_unit_name(info.geometry); }

Scene scene_of(const Arguments& arguments, Sides& sides) {
    const PictureArguments& picture = arguments.picture;
    Source& source = sides.main();
    if (source.info().extent.rank == 2)
        throw Error(ErrorKind::usage, {.file = arguments.file,
                                       .what = "a 2D volume has contour lines, not surfaces to draw in space",
                                       .next = "isoatlas extract " + shell_word(arguments.file) + " --tau T -o curves.vtp writes them"});
    Scene scene;
    scene.unit = length_unit(source.info());
    const std::vector<Wanted> all = wanted_of(arguments, sides);
    if (!picture.volume) sides.release_trees();
    for (const Wanted& wanted : all) {
        SceneObject object;
        if (picture.points > 0)
            object = points_of(arguments, sides, wanted);
        else
            object.surface = surface_of(sides, wanted), object.name = wanted.name;
        if (object.surface.points.empty()) nothing_there(arguments, "there is no surface: " + wanted.name);
        const std::size_t i = scene.objects.size();
        const Colour colour = i < picture.colours.size() ? picture.colours[i]
                              : wanted.label             ? wanted.own
                                                         : palette(static_cast<std::int64_t>(i));
        object.colour = colour;
        scene.objects.push_back(std::move(object));
    }
    choose_opacities(picture, scene.objects);
    add_samples(arguments, source, scene);
    return scene;
}

std::vector<HalfSpace> removed_part(const PictureArguments& picture, const VolumeInfo& info, const View& view) {
    if (picture.cut == CutShape::none || picture.cut == CutShape::planes) return picture.planes;
    Vec3 middle{};
    for (std::size_t a = 0; a < 3; ++a) middle[a] = static_cast<double>(info.extent.size[a] - 1) / 2;
    const Vec3 centre = to_physical(info.geometry, middle);
    std::size_t nearest = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        if (std::abs(view.toward[a]) > std::abs(view.toward[nearest])) nearest = a;
    }
    std::vector<HalfSpace> removed;
    for (std::size_t a = 0; a < 3; ++a) {
        if (picture.cut == CutShape::half && a != nearest) continue;
        HalfSpace half;
        const double sign = view.toward[a] >= 0 ? 1 : -1;
        half.normal[a] = sign;
        half.offset = sign * centre[a];
        removed.push_back(half);
    }
    return removed;
}

}  // namespace isoatlas::cli
