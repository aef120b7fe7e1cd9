#include "measures.h"

#include <memory>
#include <string>

#include <isoatlas/measures.h>

#include "call.h"
#include "source.h"
#include "words.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

py::dict dict_of(const ObjectMeasures& one, const Calibration& calibration) {
    py::dict dict;
    dict["id"] = one.id;
    dict["tau"] = calibration.reported(one.tau);
    dict["voxels"] = one.voxels;
    dict["voxel_volume"] = one.voxel_volume;
    dict["volume"] = one.volume;
    dict["area"] = one.area;
    dict["equivalent_diameter"] = one.equivalent_diameter;
    dict["sphericity"] = one.sphericity;
    dict["mean"] = one.values.mean;
    dict["min"] = one.values.min;
    dict["max"] = one.values.max;
    dict["sum"] = one.values.sum;
    dict["deviation"] = one.values.deviation;
    dict["centroid"] = one.centroid;
    dict["axes"] = one.axes.direction;
    dict["axis_lengths"] = one.axes.length;
    dict["box_centre"] = one.box.centre;
    dict["box_size"] = one.box.size;
    dict["bounds"] = one.bounds;
    dict["feret_max"] = one.feret.max;
    dict["feret_min"] = one.feret.min;
    dict["feret_mean"] = one.feret.mean;
    dict["thickness_min"] = one.thickness.min;
    dict["thickness_median"] = one.thickness.median;
    dict["euler"] = one.euler;
    dict["tunnels"] = one.tunnels;
    dict["cavities"] = one.cavities;
    dict["facets"] = one.facets;
    dict["touches_border"] = one.touches_border;
    return dict;
}

std::vector<ObjectMeasures> measure(Source& source, double tau, const std::vector<std::int64_t>& objects, bool thickness,
                                    const Context& context) {
    if (source.is_store()) return measure_objects(source.atlas(), tau, {.objects = objects, .thickness = thickness}, context);
    const MeasureOptions options{
        .interpolant = source.interpolant(), .tunnel_height = source.tunnel_height(), .objects = objects, .thickness = thickness};
    return measure_objects(*source.volume(context), tau, options, context);
}

py::list measures(const std::shared_ptr<Source>& source, double tau, const std::vector<std::int64_t>& objects, bool thickness,
                  const CallOptions& call) {
    const std::vector<ObjectMeasures> found =
        long_call(call, [=](const Context& context) { return measure(*source, tau, objects, thickness, context); });
    py::list list;
    for (const ObjectMeasures& one : found) list.append(dict_of(one, source->info().calibration));
    return list;
}

}  // namespace

void add_measures(py::module_& module) {
    module.def("measures", &measures, py::arg("source"), py::arg("tau"), py::arg("objects"), py::arg("thickness"), py::arg("call"));
}

}  // namespace isoatlas::python
