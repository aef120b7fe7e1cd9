// Surfaces: views of their arrays, files, checks.
#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include <isoatlas/interpolant.h>
#include <isoatlas/polarity.h>
#include <isoatlas/surface.h>
#include <isoatlas/verify.h>

#include "arrays.h"
#include "call.h"
#include "core.h"
#include "words.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

using Shared = std::shared_ptr<Surface>;

template <auto member>
py::array view(const py::object& self) {
    return view_of(self.cast<Surface&>().*member, self);
}

/// A copy of an array as rows.
template <class Row>
void fill(Array<Row>& rows, const py::object& given, const char* name) {
    if (given.is_none()) return;
    using Number = typename RowOf<Row>::Number;
    constexpr py::ssize_t length = RowOf<Row>::kLength;
    const auto array = py::array_t < Number, py::array::c_style | py::array::forcecast > ::ensure(given);
    if (!array) throw py::error_already_set();
    const bool fits = length == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == length;
    if (!fits) {
        throw Error(ErrorKind::usage, {.what = std::string(name) + " has another shape",
                                       .expected = length == 0 ? "(n,)" : "(n, " + std::to_string(length) + ")",
                                       .next = "reshape it"});
    }
    rows.resize(static_cast<std::size_t>(array.shape(0)));
    if (!rows.empty()) std::memcpy(rows.data(), array.data(), static_cast<std::size_t>(array.nbytes()));
}

template <std::size_t length>
void check_indices(const Array<std::array<std::int64_t, length>>& rows, std::size_t points) {
    for (const auto& row : rows) {
        for (const std::int64_t point : row) {
            if (point >= 0 && point < static_cast<std::int64_t>(points)) continue;
            throw Error(ErrorKind::usage, {.what = "there is no point " + std::to_string(point),
                                           .expected = "0 to " + std::to_string(static_cast<std::int64_t>(points) - 1),
                                           .next = "correct the triangles"});
        }
    }
}

Shared from_arrays(const py::dict& arrays, const py::dict& about) {
    auto surface = std::make_shared<Surface>();
    const auto of = [&](const char* name) { return arrays.contains(name) ? py::object(arrays[name]) : py::none(); };
    fill(surface->points, of("points"), "points");
    fill(surface->triangles, of("triangles"), "triangles");
    fill(surface->segments, of("segments"), "segments");
    fill(surface->normals, of("normals"), "normals");
    fill(surface->object, of("object"), "object");
    fill(surface->contour, of("contour"), "contour");
    check_indices(surface->triangles, surface->points.size());
    check_indices(surface->segments, surface->points.size());
    surface->tau = about["tau"].cast<double>();
    surface->reported_tau = about["reported_tau"].cast<double>();
    surface->space = about["space"].cast<std::string>();
    surface->unit = about["unit"].cast<std::string>();
    surface->closed = about["closed"].cast<bool>();
    surface->interpolant = interpolant_of(about["interpolant"].cast<std::string>());
    surface->tunnel_height = about["tunnel_height"].cast<double>();
    surface->reported_tunnel_height = about["reported_tunnel_height"].cast<double>();
    surface->polarity = polarity_of(about["polarity"].cast<std::string>());
    return surface;
}

py::dict about(const Surface& surface) {
    py::dict dict;
    dict["tau"] = surface.tau;
    dict["reported_tau"] = surface.reported_tau;
    dict["space"] = surface.space;
    dict["unit"] = surface.unit;
    dict["closed"] = surface.closed;
    dict["interpolant"] = name_of(surface.interpolant);
    dict["tunnel_height"] = surface.tunnel_height;
    dict["reported_tunnel_height"] = surface.reported_tunnel_height;
    dict["polarity"] = name_of(surface.polarity);
    return dict;
}

py::list checks_of(const std::vector<CheckResult>& checks) {
    py::list list;
    for (const CheckResult& check : checks) list.append(py::make_tuple(check.name, check.holds, check.detail));
    return list;
}

py::list verify(const Surface& surface) {
    const std::vector<CheckResult> checks = released([&] {
        Mesh mesh;
        mesh.points = surface.points, mesh.triangles = surface.triangles;
        return verify_mesh(mesh);
    });
    return checks_of(checks);
}

py::dict inspected(const Surface& surface) {
    const SurfaceReport report = released([&] { return inspect(surface.points, surface.triangles); });
    py::dict dict;
    dict["points"] = report.points;
    dict["triangles"] = report.triangles;
    dict["edges"] = report.edges;
    dict["is_closed"] = report.is_closed();
    dict["is_manifold"] = report.is_manifold();
    dict["is_oriented"] = report.is_oriented();
    dict["zero_area_triangles"] = report.zero_area_triangles;
    dict["euler_numbers"] = report.component_chi;
    return dict;
}

std::vector<std::string> write(const Surface& surface, const std::string& path, const std::string& space) {
    const PointSpace chosen = point_space_of(space);
    return released([&] { return write_surface(path, surface, {.space = chosen}); });
}

using Named = std::tuple<Shared, std::string, std::array<std::uint8_t, 3>>;

std::vector<std::string> write_several(const std::string& path, const std::vector<Named>& given, const std::string& space) {
    const PointSpace chosen = point_space_of(space);
    return released([&] {
        std::vector<NamedSurface> surfaces;
        for (const auto& [surface, name, colour] : given) surfaces.push_back({*surface, name, colour});
        return write_surfaces(path, surfaces, {.space = chosen});
    });
}

Shared read(const std::string& path) {
    return released([&] {
        Mesh mesh = read_mesh(path);
        auto surface = std::make_shared<Surface>();
        surface->points = std::move(mesh.points), surface->triangles = std::move(mesh.triangles);
        surface->object = std::move(mesh.object), surface->contour = std::move(mesh.contour);
        surface->space = mesh.space, surface->unit = mesh.unit;
        surface->closed = inspect(surface->points, surface->triangles).is_closed();
        return surface;
    });
}

}  // namespace

void add_surfaces(py::module_& module) {
    py::class_<Surface, Shared>(module, "Surface")
        .def(py::init(&from_arrays), py::arg("arrays"), py::arg("about"))
        .def_property_readonly("points", &view<&Surface::points>)
        .def_property_readonly("triangles", &view<&Surface::triangles>)
        .def_property_readonly("segments", &view<&Surface::segments>)
        .def_property_readonly("normals", &view<&Surface::normals>)
        .def_property_readonly("object", &view<&Surface::object>)
        .def_property_readonly("contour", &view<&Surface::contour>)
        .def_property_readonly("about", &about)
        .def("inspect", &inspected)
        .def("verify", &verify)
        .def("write", &write, py::arg("path"), py::arg("space"));
    module.def("write_surfaces", &write_several, py::arg("path"), py::arg("surfaces"), py::arg("space"));
    module.def("read_mesh", &read, py::arg("path"));
}

}  // namespace isoatlas::python
