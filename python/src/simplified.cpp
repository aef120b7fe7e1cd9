// Simplified trees: as arrays, reported values, and as files.
#include <memory>
#include <string>
#include <vector>

#include <isoatlas/simplify.h>

#include "arrays.h"
#include "call.h"
#include "core.h"
#include "source.h"
#include "words.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

using Counts = std::vector<std::int64_t>;

struct Nodes {
    Counts event, parent, object, voxels, object_voxels;
    std::vector<std::uint8_t> is_maximum;
    std::vector<double> low, high;
};

Nodes nodes_of(const Calibration& calibration, const BranchHierarchy& hierarchy, const Simplified& simplified) {
    Nodes nodes;
    for (const SimplifiedNode& node : simplified.nodes) {
        nodes.event.push_back(node.event.number());
        nodes.parent.push_back(node.parent);
        nodes.object.push_back(hierarchy.branches()[node.branch.index()].id);
        nodes.is_maximum.push_back(node.is_maximum ? 1 : 0);
        nodes.low.push_back(calibration.reported(node.tau_low));
        nodes.high.push_back(calibration.reported(node.tau_high));
        nodes.voxels.push_back(node.voxels);
        nodes.object_voxels.push_back(node.object_voxels);
    }
    return nodes;
}

py::tuple simplified(const std::shared_ptr<Source>& source, const py::dict& given, const CallOptions& call) {
    auto [nodes, found] = long_call(call, [=, selection = selection_of(given)](const Context& context) {
        const BranchHierarchy hierarchy = source->hierarchy(context);
        Simplified simplified = hierarchy.simplify(selection);
        return std::pair(nodes_of(source->info().calibration, hierarchy, simplified), std::move(simplified));
    });
    py::dict dict;
    dict["event"] = moved_array(std::move(nodes.event));
    dict["parent"] = moved_array(std::move(nodes.parent));
    dict["object"] = moved_array(std::move(nodes.object));
    dict["is_maximum"] = moved_array(std::move(nodes.is_maximum));
    dict["tau_low"] = moved_array(std::move(nodes.low));
    dict["tau_high"] = moved_array(std::move(nodes.high));
    dict["zone_voxels"] = moved_array(std::move(nodes.voxels));
    dict["object_voxels"] = moved_array(std::move(nodes.object_voxels));
    return py::make_tuple(dict, moved_array(std::move(found.node_of_event)), found.kept.size(), found.hidden, found.hidden_voxels);
}

void write_simplified(const std::shared_ptr<Source>& source, const py::dict& given, const std::string& path, const CallOptions& call) {
    long_call(call, [=, selection = selection_of(given)](const Context& context) {
        const BranchHierarchy hierarchy = source->hierarchy(context);
        write_simplified_tree(path, {source->info(), *source->trees(context), hierarchy, hierarchy.simplify(selection)});
    });
}

}  // namespace

void add_simplified(py::module_& module) {
    module.def("simplified", &simplified, py::arg("source"), py::arg("selection"), py::arg("call"));
    module.def("write_simplified", &write_simplified, py::arg("source"), py::arg("selection"), py::arg("path"), py::arg("call"));
}

}  // namespace isoatlas::python
