// The class Source: surfaces, cuts and labels at isovalues. Isovalues are stored ones unless a name says "reported".
#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include <isoatlas/cavities.h>
#include <isoatlas/evolution_file.h>
#include <isoatlas/isovalue.h>
#include <isoatlas/level_of_detail.h>
#include <isoatlas/levels.h>
#include <isoatlas/nested_labels.h>
#include <isoatlas/output.h>
#include <isoatlas/polarity.h>
#include <isoatlas/segmentation.h>
#include <isoatlas/verify.h>

#include "arrays.h"
#include "call.h"
#include "core.h"
#include "source.h"
#include "words.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

using Indices = std::vector<std::int64_t>;

std::shared_ptr<Source> of_volume(std::shared_ptr<Volume> volume, const std::string& interpolant, double tunnel_height) {
    return std::make_shared<Source>(std::move(volume),
                                    AnalysisOptions{.interpolant = interpolant_of(interpolant), .tunnel_height = tunnel_height});
}

std::shared_ptr<Source> of_store(const std::string& path, const std::optional<std::string>& polarity, const py::dict& corrections) {
    AtlasOptions options;
    if (polarity) options.polarity = polarity_of(*polarity);
    const OpenOptions given = open_options_of(corrections);
    options.corrections = {given.spacing, given.origin, given.unit, given.value_unit};
    return released([&] { return std::make_shared<Source>(path, options); });
}

/// octree=, octree_error=, eye=, pixels=
using OctreeWords = std::tuple<int, std::optional<double>, std::optional<Vec3>, double>;

/// Of blocks so many cells wide; nullopt: none are asked for.
std::optional<FrontOptions> front_of(const OctreeWords& words, const Geometry& geometry, bool is_simplified) {
    const auto& [cells, error, eye, pixels] = words;
    if (pixels != 1 && !eye) throw Error(ErrorKind::usage, {.what = "pixels= are seen from an eye", .next = "add eye=(x, y, z)"});
    if (cells == 0) {
        if (error || eye) throw Error(ErrorKind::usage, {.what = "octree_error= and eye= limit blocks of cells", .next = "add octree=16"});
        return std::nullopt;
    }
    if (cells < 2 || cells > 32 || !std::has_single_bit(static_cast<unsigned>(cells))) {
        throw Error(ErrorKind::usage, {.what = "octree=" + std::to_string(cells), .expected = "2, 4, 8, 16 or 32 cells, or 0"});
    }
    if (is_simplified) {
        throw Error(ErrorKind::usage, {.what = "octree= with simplify= or triangles=", .next = "give one of them"});
    }
    if (error && eye) throw Error(ErrorKind::usage, {.what = "octree_error= with eye=", .next = "give one of them"});
    FrontOptions front{.max_level = std::countr_zero(static_cast<unsigned>(cells)), .pixels = pixels};
    if (error) front.deviation = *error;
    if (eye) front.from = viewpoint_of_picture(*eye, std::ranges::min(geometry.spacing));
    return front;
}

std::shared_ptr<Surface> extract(const std::shared_ptr<Source>& source, double tau, const Indices& objects, const Indices& contours,
                                 const std::tuple<std::string, std::string, std::string>& words, bool normals, bool ids,
                                 const std::optional<double>& voxels, std::int64_t triangles, const OctreeWords& octree,
                                 const CallOptions& call) {
    const std::optional<FrontOptions> front = front_of(octree, source->info().geometry, voxels || triangles > 0);
    SurfaceOptions options;
    const auto& [boundary, style, shell] = words;
    options.boundary = boundary_of(boundary), options.style = style_of(style), options.shell = shell_of(shell);
    options.objects = objects, options.contours = contours, options.normals = normals, options.ids = ids;
    return long_call(call, [=](const Context& context) {
        if (front) return std::make_shared<Surface>(source->extract_front(tau, *front, options, context).surface);
        Surface surface = source->extract(tau, options, context);
        if (voxels || triangles > 0) {
            const SimplificationOptions simplification{.max_distance = voxels.value_or(std::numeric_limits<double>::infinity()),
                                                       .triangles = triangles};
            const VolumeInfo& info = source->info();
            surface = simplify_surface(surface, info.geometry, info.extent, simplification, context).surface;
        }
        return std::make_shared<Surface>(std::move(surface));
    });
}

/// Progress of a step as a part of the whole.
Context context_of_step(const Context& whole, std::size_t step, std::size_t steps) {
    Context own = whole;
    if (!whole.progress) return own;
    own.progress = [&whole, step, steps](const Progress& progress) {
        Progress shown = progress;
        shown.phase_index = static_cast<int>(step), shown.phase_count = static_cast<int>(steps);
        shown.fraction = (progress.phase_index + progress.fraction) / std::max(1, progress.phase_count);
        whole.progress(shown);
    };
    return own;
}

void write_evolution(const std::shared_ptr<Source>& source, const std::string& path, const std::vector<double>& taus,
                     const std::tuple<std::string, std::string, std::string>& words, bool normals, const std::string& space,
                     const CallOptions& call) {
    SurfaceOptions options;
    const auto& [boundary, style, shell] = words;
    options.boundary = boundary_of(boundary), options.style = style_of(style), options.shell = shell_of(shell);
    options.normals = normals;
    const SurfaceFileOptions file_options{.space = point_space_of(space)};
    long_call(call, [=](const Context& context) {
        EvolutionFile file(path, file_options);
        for (std::size_t i = 0; i < taus.size(); ++i) file.add(source->extract(taus[i], options, context_of_step(context, i, taus.size())));
        file.commit();
    });
}

/// surfaces: voxel, stored isovalue, whether it is a contour. Returns what the file holds, as dicts.
py::list save_levels(const std::shared_ptr<Source>& source, const std::string& path,
                     const std::vector<std::tuple<std::int64_t, double, bool>>& surfaces, const CallOptions& call) {
    if (!source->is_store()) {
        throw Error(ErrorKind::usage, {.what = "levels of detail lie beside a store, and this volume has none",
                                       .next = "isoatlas.build() makes one, isoatlas.open() opens it"});
    }
    std::vector<LevelsKey> keys;
    for (const auto& [voxel, tau, is_contour] : surfaces) keys.push_back({voxel, tau, is_contour});
    const VolumeInfo& info = source->info();
    const std::string file = path.empty() ? levels_path(info.path, polarity_of(info)) : path;
    const std::vector<PreparedLevels> held =
        long_call(call, [=](const Context& context) { return make_levels(source->atlas(), file, keys, {}, context); });
    py::list list;
    for (const PreparedLevels& surface : held) {
        py::dict dict;
        dict["id"] = surface.key.voxel;
        dict["tau"] = info.calibration.reported(surface.key.tau);
        dict["is_cavity"] = surface.key.is_contour;
        dict["triangles"] = surface.triangles;
        dict["coarsest"] = surface.coarsest;
        dict["distance"] = surface.distance;
        list.append(dict);
    }
    return list;
}

template <class Entry>
py::list boxed(const Entry& entry) {
    py::list box;
    box.append(py::cast(entry.box_low.along));
    box.append(py::cast(entry.box_high.along));
    return box;
}

/// The objects at an isovalue, as dicts.
py::list cut_at(const std::shared_ptr<Source>& source, double tau, const CallOptions& call) {
    const Cut cut = long_call(call, [=](const Context& context) { return source->cut(tau, false, context); });
    py::list objects;
    for (const CutObject& object : cut.objects) {
        py::dict dict;
        dict["id"] = object.id;
        dict["voxels"] = object.voxels;
        dict["measure"] = object.measure;
        dict["chi"] = object.chi;
        dict["tunnels"] = object.b1;
        dict["cavities"] = object.b2;
        dict["box"] = boxed(object);
        py::list contours;
        for (std::int64_t i = object.first_contour; i < object.first_contour + object.contour_count; ++i) {
            const CutContour& contour = cut.contours[static_cast<std::size_t>(i)];
            contours.append(py::make_tuple(contour.id, contour.shell == Shell::outer ? "outer" : "inner", contour.genus));
        }
        dict["contours"] = contours;
        objects.append(dict);
    }
    return objects;
}

/// (b0, b1, b2) of all objects at an isovalue.
std::array<std::int64_t, 3> betti_at(const std::shared_ptr<Source>& source, double tau, const CallOptions& call) {
    return long_call(call, [=](const Context& context) {
        const Cut cut = source->cut(tau, false, context);
        std::array<std::int64_t, 3> betti{static_cast<std::int64_t>(cut.objects.size()), 0, 0};
        for (const CutObject& object : cut.objects) betti[1] += object.b1, betti[2] += object.b2;
        return betti;
    });
}

using Labels = std::vector<std::uint32_t>;

py::array array_of(Labels labels, const Source& source) { return moved_array(std::move(labels), shape_of(source.info().extent)); }

py::tuple labels_at(const std::shared_ptr<Source>& source, double tau, const Indices& objects, const CallOptions& call) {
    auto [labels, count] = long_call(call, [=](const Context& context) {
        const Cut cut = source->cut(tau, true, context);
        return std::pair(object_labels(cut, objects), cut.objects.size());
    });
    return py::make_tuple(array_of(std::move(labels), *source), count);
}

std::pair<Labels, Indices> cavities_at(Source& source, double tau, const Context& context) {
    Indices ids;
    Labels labels = label_cavities(*source.volume(context), *source.trees(context), tau, ids, context);
    return {std::move(labels), std::move(ids)};
}

py::tuple cavity_labels_at(const std::shared_ptr<Source>& source, double tau, const CallOptions& call) {
    auto [labels, ids] = long_call(call, [=](const Context& context) { return cavities_at(*source, tau, context); });
    return py::make_tuple(array_of(std::move(labels), *source), py::cast(ids));
}

/// is_cavity, voxel, isovalue, label
using Part = std::tuple<bool, std::int64_t, double, std::uint32_t>;

py::array nested_labels_of(const std::shared_ptr<Source>& source, const std::vector<Part>& given, const CallOptions& call) {
    std::vector<NestedPart> parts;
    for (const auto& [is_cavity, voxel, tau, label] : given) parts.push_back({is_cavity, voxel, tau, label});
    Labels labels = long_call(call, [=](const Context& context) {
        const NestedSource at{[&](double tau) { return source->cut(tau, true, context).label; },
                              [&](double tau) { return cavities_at(*source, tau, context).first; }};
        return nested_labels(source->info().extent.voxels(), parts, at);
    });
    return array_of(std::move(labels), *source);
}

Labels zone_labels(Source& source, const Context& context) {
    const std::shared_ptr<const Analysis> zones = source.zones(context);
    Labels of_voxel(static_cast<std::size_t>(source.info().extent.voxels()));
    for (const VoxelId voxel : ids<VoxelId>(source.info().extent.voxels())) {
        if (voxel.number() % (1 << 20) == 0 && context.cancelled()) throw Error(ErrorKind::cancelled, {.what = "cancelled"});
        of_voxel[voxel.index()] = static_cast<std::uint32_t>(zones->zone(voxel).number() + 1);
    }
    return of_voxel;
}

py::array zones_of(const std::shared_ptr<Source>& source, const CallOptions& call) {
    return array_of(long_call(call, [=](const Context& context) { return zone_labels(*source, context); }), *source);
}

/// number, name, colour, reported isovalue, voxels, polarity
using SegmentTuple = std::tuple<std::int64_t, std::string, std::array<std::uint8_t, 3>, double, std::int64_t, std::string>;

std::vector<std::string> write_segments(const Source& source, const std::string& path, const py::array_t<std::uint32_t>& labels,
                                        const std::vector<SegmentTuple>& given) {
    std::vector<Segment> segments;
    for (const auto& [number, name, colour, isovalue, voxels, polarity] : given)
        segments.push_back({number, name, colour, isovalue, voxels, polarity_of(polarity)});
    const std::span<const std::uint32_t> of_voxel(labels.data(), static_cast<std::size_t>(labels.size()));
    return released([&] { return write_segmentation(path, of_voxel, segments, source.info()); });
}

/// tau: None for zones.
void write_label_file(const Source& source, const std::string& path, const py::array_t<std::uint32_t>& labels,
                      const std::optional<double>& tau, bool cavities) {
    const LabelOrigin origin{
        .interpolant = source.interpolant(), .tunnel_height = source.tunnel_height(), .tau = tau, .cavities = cavities};
    const std::span<const std::uint32_t> of_voxel(labels.data(), static_cast<std::size_t>(labels.size()));
    released([&] { write_labels(path, source.info(), of_voxel, origin); });
}

py::list verify(const std::shared_ptr<Source>& source, int levels, bool full, std::uint64_t seed, const CallOptions& call) {
    const std::vector<CheckResult> checks = long_call(call, [=](const Context& context) {
        if (source->is_store()) return verify_atlas(source->atlas(), {.levels = levels, .full = full, .seed = seed}, context);
        const VerifyOptions options{.levels = levels, .interpolant = source->interpolant(), .tunnel_height = source->tunnel_height()};
        return verify_volume(*source->volume(context), options, context);
    });
    py::list list;
    for (const CheckResult& check : checks) list.append(py::make_tuple(check.name, check.holds, check.detail));
    return list;
}

}  // namespace

void add_sources(py::module_& module) {
    py::class_<Source, std::shared_ptr<Source>>(module, "Source")
        .def_static("of_volume", &of_volume, py::arg("volume"), py::arg("interpolant"), py::arg("tunnel_height"))
        .def_static("of_store", &of_store, py::arg("path"), py::arg("polarity"), py::arg("corrections"))
        .def_property_readonly("info", [](const Source& source) { return dict_of(source.info()); })
        .def_property_readonly("is_store", &Source::is_store)
        .def_property_readonly("interpolant", [](const Source& source) { return name_of(source.interpolant()); })
        .def_property_readonly("tunnel_height", &Source::tunnel_height)
        .def("range", &Source::range, py::call_guard<py::gil_scoped_release>())
        .def("stored", &Source::stored, py::arg("reported"), py::call_guard<py::gil_scoped_release>())
        .def("stored_of_any", [](const Source& source, double reported) { return stored_isovalue(source.info(), reported); })
        .def("reported", [](const Source& source, double stored) { return source.info().calibration.reported(stored); })
        .def("volume",
             [](const std::shared_ptr<Source>& source, const CallOptions& call) {
                 return long_call(call, [=](const Context& context) { return std::const_pointer_cast<Volume>(source->volume(context)); });
             })
        .def("extract", &extract, py::arg("tau"), py::arg("objects"), py::arg("contours"), py::arg("words"), py::arg("normals"),
             py::arg("ids"), py::arg("simplify"), py::arg("triangles"), py::arg("octree"), py::arg("call"))
        .def("save_levels", &save_levels, py::arg("path"), py::arg("surfaces"), py::arg("call"))
        .def("write_evolution", &write_evolution, py::arg("path"), py::arg("taus"), py::arg("words"), py::arg("normals"), py::arg("space"),
             py::arg("call"))
        .def("cut", &cut_at, py::arg("tau"), py::arg("call"))
        .def("betti", &betti_at, py::arg("tau"), py::arg("call"))
        .def("labels", &labels_at, py::arg("tau"), py::arg("objects"), py::arg("call"))
        .def("cavity_labels", &cavity_labels_at, py::arg("tau"), py::arg("call"))
        .def("nested_labels", &nested_labels_of, py::arg("parts"), py::arg("call"))
        .def("zones", &zones_of, py::arg("call"))
        .def("write_segments", &write_segments, py::arg("path"), py::arg("labels"), py::arg("segments"))
        .def("write_labels", &write_label_file, py::arg("path"), py::arg("labels"), py::arg("tau"), py::arg("cavities"))
        .def("verify", &verify, py::arg("levels"), py::arg("full"), py::arg("seed"), py::arg("call"));
}

}  // namespace isoatlas::python
