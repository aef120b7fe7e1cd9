// Names of objects, beside the store; regions of label volumes.
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <isoatlas/labels.h>
#include <isoatlas/object_names.h>
#include <isoatlas/polarity.h>

#include "arrays.h"
#include "call.h"
#include "core.h"
#include "source.h"
#include "words.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

/// name, voxel, isovalue (calibrated), is_cavity
using Name = std::tuple<std::string, std::int64_t, double, bool>;

std::string file_of(const VolumeInfo& info) { return object_names_path(info.path, polarity_of(info)); }

std::vector<Name> names(const std::shared_ptr<Source>& source) {
    std::vector<Name> names;
    for (const ObjectName& one : read_object_names(file_of(source->info()), source->info().extent))
        names.emplace_back(one.name, one.voxel, one.isovalue, one.is_cavity);
    return names;
}

/// An empty name takes away the one that the object has.
void give_name(const std::shared_ptr<Source>& source, const std::string& name, std::int64_t voxel, double isovalue, bool is_cavity) {
    const VolumeInfo& info = source->info();
    std::vector<ObjectName> all = read_object_names(file_of(info), info.extent);
    if (name.empty()) {
        std::erase_if(all, [&](const ObjectName& one) { return find_object_name({&one, 1}, is_cavity, voxel, isovalue) != nullptr; });
    } else {
        set_object_name(all, {name, voxel, isovalue, is_cavity});
    }
    write_object_names(file_of(info), info.extent, all);
}

py::dict label_regions(const std::shared_ptr<Volume>& volume, const std::string& interpolant, const CallOptions& call) {
    const LabelOptions options{.interpolant = interpolant_of(interpolant)};
    const LabelTable table = long_call(call, [=](const Context& context) { return list_labels(*volume, options, context); });
    std::vector<std::int64_t> label, voxels, components, tunnels, cavities;
    std::vector<double> measure;
    std::vector<std::array<std::int64_t, 3>> low, high;
    std::vector<Vec3> position;
    for (const LabelRegion& region : table.regions) {
        label.push_back(region.label), voxels.push_back(region.voxels), measure.push_back(region.measure);
        components.push_back(region.components), tunnels.push_back(region.tunnels), cavities.push_back(region.cavities);
        low.push_back({region.box_low[0], region.box_low[1], region.box_low[2]});
        high.push_back({region.box_high[0], region.box_high[1], region.box_high[2]});
        position.push_back(to_physical(volume->info.geometry, region.position));
    }
    py::dict dict;
    dict["label"] = moved_array(std::move(label));
    dict["voxels"] = moved_array(std::move(voxels));
    dict["measure"] = moved_array(std::move(measure));
    dict["components"] = moved_array(std::move(components));
    dict["tunnels"] = moved_array(std::move(tunnels));
    dict["cavities"] = moved_array(std::move(cavities));
    dict["box_low"] = moved_array(std::move(low));
    dict["box_high"] = moved_array(std::move(high));
    dict["position"] = moved_array(std::move(position));
    return dict;
}

std::shared_ptr<Surface> label_surface(const std::shared_ptr<Volume>& volume, std::int64_t label, const std::string& interpolant,
                                       const std::string& boundary, bool normals, const CallOptions& call) {
    ExtractOptions options{.interpolant = interpolant_of(interpolant)};
    options.surface.boundary = boundary_of(boundary);
    options.surface.normals = normals;
    return long_call(call,
                     [=](const Context& context) { return std::make_shared<Surface>(extract_label(*volume, label, options, context)); });
}

}  // namespace

void add_names(py::module_& module) {
    module.def("names", &names, py::arg("source"));
    module.def("give_name", &give_name, py::arg("source"), py::arg("name"), py::arg("voxel"), py::arg("isovalue"), py::arg("is_cavity"));
    module.def("label_regions", &label_regions, py::arg("volume"), py::arg("interpolant"), py::arg("call"));
    module.def("label_surface", &label_surface, py::arg("volume"), py::arg("label"), py::arg("interpolant"), py::arg("boundary"),
               py::arg("normals"), py::arg("call"));
}

}  // namespace isoatlas::python
