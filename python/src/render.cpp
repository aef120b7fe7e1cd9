// The module isoatlas._render: pictures and measures, which need Embree. It uses the classes of isoatlas._core.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <isoatlas/image.h>
#include <isoatlas/objects.h>
#include <isoatlas/render.h>

#include "arrays.h"
#include "call.h"
#include "errors.h"
#include "measures.h"
#include "source.h"
#include "words.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

using Bytes = std::array<std::uint8_t, 3>;

Colour colour_of(const Bytes& bytes) { return {bytes[0] / 255.0, bytes[1] / 255.0, bytes[2] / 255.0}; }

Bytes bytes_of(const Colour& colour) {
    const auto byte = [](double part) { return static_cast<std::uint8_t>(std::lround(std::clamp(part, 0.0, 1.0) * 255)); };
    return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

py::array array_of(Image image) {
    return moved_array(std::move(image.rgba), {static_cast<py::ssize_t>(image.height), static_cast<py::ssize_t>(image.width), 4});
}

Image image_of(const py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>& array) {
    if (array.ndim() != 3 || array.shape(2) != 4)
        throw Error(ErrorKind::usage, {.what = "a picture has another shape", .expected = "(height, width, 4)", .next = "reshape it"});
    Image image(array.shape(1), array.shape(0));
    std::copy_n(array.data(), image.rgba.size(), image.rgba.begin());
    return image;
}

RenderOptions options_of(const py::dict& given) {
    RenderOptions options;
    options.width = given["width"].cast<std::int64_t>(), options.height = given["height"].cast<std::int64_t>();
    options.projection =
        choice_of("projection", given["projection"].cast<std::string>(),
                  std::array{std::pair("orthographic", Projection::orthographic), std::pair("perspective", Projection::perspective)});
    options.background = choice_of("background", given["background"].cast<std::string>(),
                                   std::array{std::pair("light", Background::light), std::pair("dark", Background::dark),
                                              std::pair("transparent", Background::transparent)});
    options.samples = given["samples"].cast<int>();
    options.shading = given["shading"].cast<bool>();
    options.scale_bar = given["scale_bar"].cast<bool>();
    options.legend = given["legend"].cast<bool>();
    options.caption = given["caption"].cast<std::vector<std::string>>();
    return options;
}

/// None given: the best one; else degrees around and above.
View view_of(const std::optional<std::array<double, 2>>& view, const Scene& scene, const Vec3& up, const Context& context) {
    return view ? view_from((*view)[0], (*view)[1], up) : best_view(scene, up, context);
}

using Drawn = std::tuple<std::shared_ptr<Surface>, Bytes, double, std::string>;

Scene scene_of(const std::vector<Drawn>& drawn) {
    Scene scene;
    for (const auto& [surface, colour, opacity, name] : drawn)
        scene.objects.push_back({.surface = *surface, .colour = colour_of(colour), .opacity = opacity, .name = name});
    return scene;
}

/// source: None, or that of a volume to be drawn itself; slices: axis and index of its samples.
py::array render(const std::vector<Drawn>& drawn, const py::object& source, bool draws_volume,
                 const std::vector<std::pair<int, std::int64_t>>& slices, const py::object& view, const Vec3& up, const py::dict& given,
                 const CallOptions& call) {
    const RenderOptions options = options_of(given);
    const auto direction = view.is_none() ? std::optional<std::array<double, 2>>() : view.cast<std::array<double, 2>>();
    const auto of = source.is_none() ? std::shared_ptr<Source>() : source.cast<std::shared_ptr<Source>>();
    return array_of(long_call(call, [=](const Context& context) {
        Scene scene = scene_of(drawn);
        std::shared_ptr<const Volume> volume;
        if (of && (draws_volume || !slices.empty())) volume = of->volume(context);
        for (const auto& [axis, index] : slices) scene.slices.push_back(slice_picture(*volume, {.axis = axis, .index = index}, context));
        if (draws_volume && volume) {
            scene.volume.volume = volume.get();
            scene.volume.range = of->range();
            scene.volume.tents = propose_transfer(of->objects({}, context), volume->info, of->range());
            scene.unit = volume->info.geometry.unit;
        }
        const Camera camera = fit_camera(scene, view_of(direction, scene, up, context), options);
        return render_scene(scene, camera, options, context);
    }));
}

void write_animation_of(const std::string& path, const std::vector<py::array>& frames, double frames_per_second) {
    Animation animation{.frames = {}, .frames_per_second = frames_per_second};
    for (const py::array& frame : frames) animation.frames.push_back(image_of(frame));
    released([&] { write_animation(path, animation); });
}

}  // namespace
}  // namespace isoatlas::python

PYBIND11_MODULE(_render, module) {
    using namespace isoatlas;
    using namespace isoatlas::python;
    py::module_::import("isoatlas._core");
    translate_exceptions();
    py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_abandoned_calls));
    module.def("render", &render, py::arg("surfaces"), py::arg("source"), py::arg("draws_volume"), py::arg("slices"), py::arg("view"),
               py::arg("up"), py::arg("options"), py::arg("call"));
    module.def("colour_of", [](std::int64_t number, bool is_cavity) {
        return bytes_of(is_cavity ? colour_of_cavity(number) : colour_of_object(number));
    });
    module.def("write_image", [](const std::string& path, const py::array& image) { write_image(path, image_of(image)); });
    module.def("write_animation", &write_animation_of, py::arg("path"), py::arg("frames"), py::arg("frames_per_second"));
    add_measures(module);
}
