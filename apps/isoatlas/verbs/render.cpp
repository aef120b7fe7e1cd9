// isoatlas render: a picture of objects, without a display.
#include <algorithm>

#include <fmt/format.h>

#include "data/picture.h"
#include "data/sides.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

Json curves_json(const PictureArguments& picture) {
    Json curves = Json::array();
    for (const ShownCurve& curve : picture.curves) {
        Json points = Json::array();
        for (const ShownCurve::Point& point : curve.points) {
            points.push_back({{"value", point.value},
                              {"opacity", point.opacity},
                              {"colour", {point.colour.red, point.colour.green, point.colour.blue}}});
        }
        curves.push_back({{"points", std::move(points)}});
    }
    return curves;
}

/// null: no volume rendering.
Json optics_json(const PictureArguments& picture) {
    if (!picture.volume) return nullptr;
    Json json{{"model", optics_name(picture.optics)}};
    const bool is_multiple = picture.optics == OpticalModel::multiple_scattering;
    if (!is_multiple && picture.optics != OpticalModel::single_scattering) return json;
    const Scattering& scattering = picture.scattering;
    json["albedo"] = scattering.albedo;
    json["asymmetry"] = scattering.asymmetry;
    json["light"] = nullptr;
    if (scattering.to_light != Vec3{}) json["light"] = scattering.to_light;
    if (is_multiple) json["sky"] = scattering.sky;
    return json;
}

Json to_json(const Arguments& arguments, Source& source, const Scene& scene, const Image& image, const Camera& camera) {
    Json json = document("render", source.info(), source.interpolant(), source.tunnel_height());
    json["output"] = arguments.output;
    json["width"] = image.width;
    json["height"] = image.height;
    Json objects = Json::array();
    for (const SceneObject& object : scene.objects) {
        objects.push_back({{"name", object.name},
                           {"tau", object.surface.reported_tau},
                           {"opacity", object.opacity},
                           {"colour", {object.colour.red, object.colour.green, object.colour.blue}},
                           {"points", object.surface.points.size()},
                           {"triangles", object.surface.triangles.size()}});
    }
    json["objects"] = std::move(objects);
    json["slices"] = scene.slices.size();
    Json tents = Json::array();
    const Scale scale(source.info());
    for (const OpacityTent& bump : scene.volume.tents) {
        const auto [low, high] = scale.ends(bump.low, bump.high);
        tents.push_back({{"low", scale.reported(low)},
                         {"high", scale.reported(high)},
                         {"density", bump.density},
                         {"colour", {bump.colour.red, bump.colour.green, bump.colour.blue}}});
    }
    json["transfer"] = std::move(tents);
    Json materials = Json::array();
    for (const ShownMaterial& material : arguments.picture.materials) {
        materials.push_back({{"name", material.name},
                             {"mean", material.mean},
                             {"sigma", material.sigma},
                             {"opacity", material.opacity},
                             {"colour", {material.colour.red, material.colour.green, material.colour.blue}}});
    }
    json["materials"] = std::move(materials);
    json["curves"] = curves_json(arguments.picture);
    json["optics"] = optics_json(arguments.picture);
    json["camera"] = nullptr;
    if (!arguments.picture.flat)
        json["camera"] = {{"projection", camera.projection == Projection::orthographic ? "orthographic" : "perspective"},
                          {"target", camera.target},
                          {"toward", camera.view.toward},
                          {"up", camera.view.up},
                          {"height", camera.height}};
    add_reads(json, source.reads());
    return json;
}

/// A slice that has z in its plane shows it upwards; --up -z flips it.
Image upright(Image slice, const PictureArguments& picture) {
    if (picture.slices[0].axis == 2 || picture.up[2] >= 0) return slice;
    Image rotated(slice.width, slice.height);
    for (std::int64_t y = 0; y < slice.height; ++y) {
        for (std::int64_t x = 0; x < slice.width; ++x)
            std::copy_n(slice.at(x, y), 4, rotated.at(slice.width - 1 - x, slice.height - 1 - y));
    }
    return rotated;
}

std::string contents_text(const Scene& scene) {
    std::string text;
    const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
    const auto clouds = std::ranges::count_if(scene.objects, [](const SceneObject& object) { return object.surface.triangles.empty(); });
    if (const std::int64_t surfaces = std::ssize(scene.objects) - clouds; surfaces > 0) add(counted(surfaces, "surface"));
    if (clouds > 0) add(counted(clouds, "cloud") + " of points");
    if (!scene.slices.empty()) add(counted(static_cast<std::int64_t>(scene.slices.size()), "slice"));
    if (scene.volume.volume != nullptr) add("volume");
    return text;
}

}  // namespace

int run_render(const Arguments& arguments, Terminal& terminal) {
    check_output(arguments, {".png", ".webp"});
    Sides sides(arguments, terminal);
    Source& source = sides.main();
    const PictureArguments& picture = arguments.picture;
    Scene scene = scene_of(arguments, sides);
    const RenderOptions options = options_of_picture(picture);
    Camera camera;
    Image image;
    if (picture.flat) {
        image = upright(scene.slices[0].picture, picture);
    } else {
        if (picture.camera) {
            camera = camera_of(*picture.camera, picture);
        } else {
            camera = fit_camera(scene, picture.view ? *picture.view : best_view(scene, picture.up, source.context()), options);
        }
        scene.removed = removed_part(picture, source.info(), camera.view);
        image = render_scene(scene, camera, options, source.context());
    }
    {
        const WritingGuard guard;
        write_image(arguments.output, image);
    }
    if (arguments.json) {
        print(terminal, to_json(arguments, source, scene, image, camera));
        return 0;
    }
    terminal.out() << fmt::format("{}: {}, {} x {} pixels\n", shown_name(arguments.output), contents_text(scene), image.width,
                                  image.height);
    for (const SceneObject& object : scene.objects) terminal.detail("  " + object.name);
    return 0;
}

}  // namespace isoatlas::cli
