// Tables of objects and cavities, as lists of dicts. Isovalues are reported ones; `tau` beside them is the stored one, exact.
#include <memory>
#include <string>

#include <isoatlas/cards.h>
#include <isoatlas/cavities.h>
#include <isoatlas/objects.h>

#include "call.h"
#include "core.h"
#include "source.h"
#include "words.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

RankOptions rank_options(std::int64_t top, bool gate, const py::object& selection) {
    RankOptions options{.top = top, .gate = gate};
    if (!selection.is_none()) options.selection = selection_of(selection);
    return options;
}

/// What objects and cavities have in common.
template <class Entry>
py::dict row_of(const Entry& entry, const VolumeInfo& info) {
    const Calibration& calibration = info.calibration;
    py::dict row;
    row["id"] = entry.id;
    row["appears"] = calibration.reported(entry.appears);
    row["merges"] = calibration.reported(entry.merges);
    row["best_tau"] = calibration.reported(entry.best_tau);
    row["tau"] = entry.best_tau;
    row["tau_range"] = calibration.reported_interval(entry.tau_low, entry.tau_high);
    row["voxels"] = entry.voxels;
    row["measure"] = entry.measure;
    row["hypervolume"] = entry.hypervolume * calibration.slope;
    row["tunnels"] = entry.tunnels;
    row["voxel"] = entry.position;
    row["position"] = to_physical(info.geometry, entry.position);
    row["inside"] = entry.inside;
    row["note"] = entry.note;
    return row;
}

py::list isovalues(const std::vector<RecommendedIsovalue>& given, std::int64_t branch, const Calibration& calibration) {
    py::list list;
    for (const RecommendedIsovalue& one : isovalues_of(given, branch))
        list.append(py::make_tuple(calibration.reported(one.tau), name_of(one.reason), text_of(one.reason), one.prominence, one.tau));
    return list;
}

py::dict object_row(const ObjectTable& table, std::size_t line, const VolumeInfo& info) {
    const ObjectEntry& entry = table.entries[line];
    py::dict row = row_of(entry, info);
    row["cavities"] = entry.cavities;
    row["event"] = entry.event.number();
    row["branch"] = entry.branch_top.number();
    const std::optional<RecommendedIsovalue> best = isovalue_of(table, entry);
    row["reason"] = best ? py::object(py::str(name_of(best->reason))) : py::none();
    row["why"] = best ? py::object(py::str(text_of(best->reason))) : py::none();
    row["isovalues"] = isovalues(table.isovalues, entry.branch_top.number(), info.calibration);
    row["outline"] = entry.outline;
    row["main_branch"] = entry.main_branch;
    row["background"] = is_background(table, line, info.extent);
    row["border"] = sides_text(entry.border);
    return row;
}

py::dict objects(const std::shared_ptr<Source>& source, std::int64_t top, bool gate, const py::object& selection, const CallOptions& call) {
    const RankOptions options = rank_options(top, gate, selection);
    const ObjectTable table = long_call(call, [=](const Context& context) { return source->objects(options, context); });
    py::list rows;
    for (std::size_t line = 0; line < table.entries.size(); ++line) rows.append(object_row(table, line, source->info()));
    py::dict result;
    result["rows"] = rows;
    result["branches"] = table.branches;
    result["noise"] = table.noise * source->info().calibration.slope;
    return result;
}

py::dict cavities(const std::shared_ptr<Source>& source, std::int64_t top, bool gate, const py::object& selection,
                  const CallOptions& call) {
    const RankOptions options = rank_options(top, gate, selection);
    const CavityTable table = long_call(call, [=](const Context& context) { return source->cavities(options, context); });
    py::list rows;
    for (const CavityEntry& entry : table.entries) {
        py::dict row = row_of(entry, source->info());
        row["islands"] = entry.islands;
        row["object"] = entry.object;
        row["reason"] = name_of(entry.reason);
        row["why"] = text_of(entry.reason);
        row["isovalues"] = isovalues(table.isovalues, entry.branch_minimum, source->info().calibration);
        rows.append(row);
    }
    py::dict result;
    result["rows"] = rows;
    result["branches"] = table.branches;
    result["noise"] = table.noise * source->info().calibration.slope;
    return result;
}

}  // namespace

void add_tables(py::module_& module) {
    module.def("objects", &objects, py::arg("source"), py::arg("top"), py::arg("gate"), py::arg("selection"), py::arg("call"));
    module.def("cavities", &cavities, py::arg("source"), py::arg("top"), py::arg("gate"), py::arg("selection"), py::arg("call"));
}

}  // namespace isoatlas::python
