// isoatlas render: a picture of objects, without a display.
#include <fmt/format.h>

#include "document.h"
#include "interrupt.h"
#include "picture.h"
#include "source.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace isoatlas::cli {
namespace {

RenderOptions options_of_picture(const PictureArguments& picture) {
    RenderOptions options{.width = picture.width, .height = picture.height};
    options.projection = picture.perspective ? Projection::perspective : Projection::orthographic;
    options.background = picture.background;
    options.samples = picture.samples;
    options.scale_bar = options.legend = !picture.plain;
    return options;
}

Json to_json(const Arguments& arguments, Source& source, const Scene& scene, const Camera& camera) {
    Json json = document("render", source.info(), source.interpolant(), source.tunnel_height());
    json["output"] = arguments.output;
    json["width"] = arguments.picture.width;
    json["height"] = arguments.picture.height;
    Json objects = Json::array();
    for (const SceneObject& object : scene.objects) {
        objects.push_back({{"name", object.name},
                           {"tau", object.surface.reported_tau},
                           {"opacity", object.opacity},
                           {"colour", {object.colour.red, object.colour.green, object.colour.blue}},
                           {"triangles", object.surface.triangles.size()}});
    }
    json["objects"] = std::move(objects);
    json["camera"] = {{"projection", camera.projection == Projection::orthographic ? "orthographic" : "perspective"},
                      {"target", camera.target},
                      {"toward", camera.view.toward},
                      {"up", camera.view.up},
                      {"height", camera.height}};
    add_reads(json, source.reads());
    return json;
}

}  // namespace

int run_render(const Arguments& arguments, Terminal& terminal) {
    check_output(arguments, {".png"});
    Source source(arguments, terminal);
    const PictureArguments& picture = arguments.picture;
    Scene scene = scene_of(arguments, source);
    const RenderOptions options = options_of_picture(picture);
    const View view = picture.view ? *picture.view : best_view(scene, source.context());
    scene.removed = removed_part(picture, scene, view);
    const Camera camera = fit_camera(scene, view, options);
    const Image image = render_scene(scene, camera, options, source.context());
    {
        const WritingGuard guard(arguments.output);
        write_image(arguments.output, image);
    }
    if (arguments.json) {
        print(terminal, to_json(arguments, source, scene, camera));
        return 0;
    }
    terminal.out() << arguments.output << ": " << counted(static_cast<std::int64_t>(scene.objects.size()), "object") << ", "
                   << picture.width << " x " << picture.height << " pixels\n";
    for (const SceneObject& object : scene.objects) terminal.detail("  " + object.name);
    return 0;
}

}  // namespace isoatlas::cli
