// Trees, persistence, tunnels and the spectrum: as arrays, reported values.
#include <algorithm>
#include <memory>
#include <string>

#include <isoatlas/handles.h>
#include <isoatlas/output.h>
#include <isoatlas/persistence.h>
#include <isoatlas/polarity.h>
#include <isoatlas/spectrum.h>

#include "arrays.h"
#include "call.h"
#include "core.h"
#include "source.h"
#include "words.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

using Numbers = std::vector<double>;
using Counts = std::vector<std::int64_t>;

/// One element for each event.
struct EventColumns {
    Numbers value, low, high;
    std::vector<std::int8_t> kind;
    Counts parent, voxels, object_voxels, euler, tunnels, cavities, contours;
    std::vector<std::array<double, 3>> voxel, position;
};

EventColumns columns_of(const VolumeInfo& info, const Analysis& analysis) {
    const Calibration& calibration = info.calibration;
    const bool is_low = isoatlas::polarity_of(info) == Polarity::low;
    EventColumns columns;
    for (const EventId id : ids<EventId>(analysis.event_count())) {
        const Event event = analysis.event(id);
        columns.value.push_back(calibration.reported(event.value));
        columns.kind.push_back(static_cast<std::int8_t>(is_low ? mirrored(event.kind) : event.kind));
        columns.parent.push_back(event.parent.number());
        columns.low.push_back(calibration.reported(event.zone.tau_low));
        columns.high.push_back(calibration.reported(event.zone.tau_high));
        columns.voxels.push_back(event.zone.voxels);
        columns.object_voxels.push_back(event.object_voxels);
        columns.euler.push_back(event.chi);
        columns.tunnels.push_back(event.b1);
        columns.cavities.push_back(event.b2);
        columns.contours.push_back(event.contours);
        columns.voxel.push_back(event.position);
        columns.position.push_back(to_physical(info.geometry, event.position));
    }
    return columns;
}

py::dict tree_arrays(const std::shared_ptr<Source>& source, const CallOptions& call) {
    EventColumns columns = long_call(call, [=](const Context& context) { return columns_of(source->info(), *source->trees(context)); });
    py::dict dict;
    dict["value"] = moved_array(std::move(columns.value));
    dict["kind"] = moved_array(std::move(columns.kind));
    dict["parent"] = moved_array(std::move(columns.parent));
    dict["tau_low"] = moved_array(std::move(columns.low));
    dict["tau_high"] = moved_array(std::move(columns.high));
    dict["zone_voxels"] = moved_array(std::move(columns.voxels));
    dict["object_voxels"] = moved_array(std::move(columns.object_voxels));
    dict["euler"] = moved_array(std::move(columns.euler));
    dict["tunnels"] = moved_array(std::move(columns.tunnels));
    dict["cavities"] = moved_array(std::move(columns.cavities));
    dict["contours"] = moved_array(std::move(columns.contours));
    dict["voxel"] = moved_array(std::move(columns.voxel));
    dict["position"] = moved_array(std::move(columns.position));
    return dict;
}

std::vector<std::string> kinds() {
    std::vector<std::string> names;
    for (int kind = 0; kind <= static_cast<int>(Criticality::complex); ++kind) names.emplace_back(name_of(static_cast<Criticality>(kind)));
    return names;
}

struct ContourColumns {
    Counts upper, lower, genus;
    Numbers high, low;
};

ContourColumns contour_columns_of(const Calibration& calibration, const Analysis& trees) {
    ContourColumns columns;
    for (std::int64_t i = 0; i < trees.contour_arc_count(); ++i) {
        const ContourArc arc = trees.contour_arc(i);
        columns.upper.push_back(arc.upper.number()), columns.lower.push_back(arc.lower.number()), columns.genus.push_back(arc.genus);
        columns.high.push_back(calibration.reported(arc.value_high)), columns.low.push_back(calibration.reported(arc.value_low));
    }
    return columns;
}

py::dict contour_arrays(const std::shared_ptr<Source>& source, const CallOptions& call) {
    ContourColumns columns =
        long_call(call, [=](const Context& context) { return contour_columns_of(source->info().calibration, *source->trees(context)); });
    py::dict dict;
    dict["upper"] = moved_array(std::move(columns.upper));
    dict["lower"] = moved_array(std::move(columns.lower));
    dict["genus"] = moved_array(std::move(columns.genus));
    dict["tau_high"] = moved_array(std::move(columns.high));
    dict["tau_low"] = moved_array(std::move(columns.low));
    return dict;
}

/// find: pair_objects or pair_cavities.
template <class Pair>
py::array pairs_of(const std::shared_ptr<Source>& source, std::vector<Pair> (*find)(const Analysis&), const CallOptions& call) {
    return moved_array(long_call(call, [=](const Context& context) {
        std::vector<std::array<double, 2>> pairs;
        const Calibration& calibration = source->info().calibration;
        for (const Pair& pair : find(*source->trees(context)))
            pairs.push_back({calibration.reported(pair.born), calibration.reported(pair.dies)});
        return pairs;
    }));
}

py::array object_pairs(const std::shared_ptr<Source>& source, const CallOptions& call) { return pairs_of(source, pair_objects, call); }
py::array cavity_pairs(const std::shared_ptr<Source>& source, const CallOptions& call) { return pairs_of(source, pair_cavities, call); }

/// exact: reads the samples.
std::vector<Handle> found(Source& source, bool exact, double min_persistence, std::int64_t voxel, const Context& context) {
    const std::shared_ptr<const Analysis> trees = source.trees(context);
    if (!exact) return pair_handles(*trees, min_persistence);
    ExactHandles options{.min_persistence = min_persistence};
    if (voxel >= 0) {
        options.event = event_of_highest(*trees, VoxelId(voxel));
        if (!options.event.exists())
            throw Error(ErrorKind::not_found, {.what = "voxel " + std::to_string(voxel) + " is not the highest one of an object",
                                               .next = "give the id of an object of the table"});
    }
    return pair_handles_exactly(*source.volume(context), *trees, options, context);
}

py::dict handles(const std::shared_ptr<Source>& source, bool exact, double min_persistence, std::int64_t voxel, const CallOptions& call) {
    const std::vector<Handle> handles =
        long_call(call, [=](const Context& context) { return found(*source, exact, min_persistence, voxel, context); });
    const VolumeInfo& info = source->info();
    std::vector<std::array<double, 2>> pairs;
    std::vector<std::array<double, 3>> opened, closed;
    std::vector<std::uint8_t> open;
    for (const Handle& handle : handles) {
        pairs.push_back({info.calibration.reported(handle.opens), info.calibration.reported(handle.closes)});
        opened.push_back(to_physical(info.geometry, handle.opened_at));
        closed.push_back(to_physical(info.geometry, handle.closed_at));
        open.push_back(handle.is_open ? 1 : 0);
    }
    py::dict dict;
    dict["pairs"] = moved_array(std::move(pairs));
    dict["opened_at"] = moved_array(std::move(opened));
    dict["closed_at"] = moved_array(std::move(closed));
    dict["is_open"] = moved_array(std::move(open));
    return dict;
}

py::dict spectrum_arrays(const Spectrum& found, const Calibration& calibration) {
    Numbers low, high, tau, area, measure;
    Counts objects, contours, tunnels, cavities, significant, facets;
    for (const SpectrumInterval& one : found.intervals) {
        low.push_back(calibration.reported(one.low)), high.push_back(calibration.reported(one.high));
        objects.push_back(one.all.objects), contours.push_back(one.all.contours);
        tunnels.push_back(one.all.tunnels), cavities.push_back(one.all.cavities);
        significant.push_back(one.significant.objects);
    }
    for (const SpectrumSize& one : found.sizes) {
        tau.push_back(calibration.reported(one.tau)), area.push_back(one.area), measure.push_back(one.measure);
        facets.push_back(one.facets);
    }
    py::dict dict;
    dict["tau_low"] = moved_array(std::move(low));
    dict["tau_high"] = moved_array(std::move(high));
    dict["objects"] = moved_array(std::move(objects));
    dict["contours"] = moved_array(std::move(contours));
    dict["tunnels"] = moved_array(std::move(tunnels));
    dict["cavities"] = moved_array(std::move(cavities));
    dict["significant"] = moved_array(std::move(significant));
    dict["size_tau"] = moved_array(std::move(tau));
    dict["size_facets"] = moved_array(std::move(facets));
    dict["size_area"] = moved_array(std::move(area));
    dict["size_measure"] = moved_array(std::move(measure));
    return dict;
}

Spectrum spectrum_of(Source& source, std::int64_t samples, const Context& context) {
    const SpectrumOptions options{.samples = samples};
    if (source.is_store()) return isoatlas::spectrum(source.atlas(), options, context);
    return isoatlas::spectrum(*source.volume(context), *source.trees(context), options, context);
}

py::dict spectrum(const std::shared_ptr<Source>& source, std::int64_t samples, const CallOptions& call) {
    const Spectrum found = long_call(call, [=](const Context& context) { return spectrum_of(*source, samples, context); });
    return spectrum_arrays(found, source->info().calibration);
}

void write_spectrum_file(const std::shared_ptr<Source>& source, const std::string& path, std::int64_t samples, const CallOptions& call) {
    long_call(call, [=](const Context& context) { write_spectrum(path, source->info(), spectrum_of(*source, samples, context)); });
}

void write_tree_file(const std::shared_ptr<Source>& source, const std::string& path, const std::string& detail, bool all,
                     const CallOptions& call) {
    const TreeOutput output{
        .detail = choice_of("detail", detail,
                            std::array{std::pair("events", TreeDetail::events), std::pair("levels", TreeDetail::levels),
                                       std::pair("elements", TreeDetail::elements), std::pair("contours", TreeDetail::contours)}),
        .all = all};
    long_call(call, [=](const Context& context) {
        Volume header;  // the file needs no sample
        header.info = source->info();
        write_tree(path, header, *source->trees(context), output);
    });
}

}  // namespace

void add_trees(py::module_& module) {
    module.def("tree", &tree_arrays, py::arg("source"), py::arg("call"));
    module.def("tree_kinds", &kinds);
    module.def("contours", &contour_arrays, py::arg("source"), py::arg("call"));
    module.def("cavity_pairs", &cavity_pairs, py::arg("source"), py::arg("call"));
    module.def("object_pairs", &object_pairs, py::arg("source"), py::arg("call"));
    module.def("handles", &handles, py::arg("source"), py::arg("exact"), py::arg("min_persistence"), py::arg("voxel"), py::arg("call"));
    module.def("spectrum", &spectrum, py::arg("source"), py::arg("samples"), py::arg("call"));
    module.def("write_spectrum", &write_spectrum_file, py::arg("source"), py::arg("path"), py::arg("samples"), py::arg("call"));
    module.def("write_tree", &write_tree_file, py::arg("source"), py::arg("path"), py::arg("detail"), py::arg("all"), py::arg("call"));
}

}  // namespace isoatlas::python
