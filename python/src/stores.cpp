// Stores: built from volumes of any size, files or what Python reads slab by slab.
#include <cmath>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

#include <isoatlas/atlas.h>
#include <isoatlas/build.h>
#include <isoatlas/environment.h>
#include <isoatlas/polarity.h>

#include "arrays.h"
#include "call.h"
#include "core.h"
#include "words.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

/// options: interpolant, tunnel_height (calibrated), gaussian, memory, polarity ("high", "low", "both"), restart.
BuildOptions build_options_of(const py::dict& options, const VolumeInfo& info, const MissingPolicy& missing) {
    BuildOptions build;
    build.missing = missing;
    build.analysis.interpolant = interpolant_of(options["interpolant"].cast<std::string>());
    build.analysis.tunnel_height = options["tunnel_height"].cast<double>() / std::abs(info.calibration.slope);
    build.gaussian = options["gaussian"].cast<double>();
    build.memory = options["memory"].cast<std::int64_t>();
    build.restart = options["restart"].cast<bool>();
    build.polarities = choice_of("polarity", options["polarity"].cast<std::string>(),
                                 std::array{std::pair("high", PolarityChoice::high), std::pair("low", PolarityChoice::low),
                                            std::pair("both", PolarityChoice::both)});
    return build;
}

py::dict built(const std::string& path, const std::shared_ptr<VolumeReader>& reader, const BuildOptions& build, const CallOptions& call) {
    wait_for_abandoned_calls_or_signal();  // an interrupted build may still hold the store
    const BuildReport report = long_call(call, [=](const Context& context) { return build_atlas(path, *reader, build, context); });
    py::dict dict;
    dict["resumed"] = report.resumed;
    dict["not_used"] = report.not_used;
    dict["peak_memory"] = report.peak_memory;
    dict["bytes"] = report.bytes;
    return dict;
}

py::dict build_from_file(const std::string& path, const std::string& volume, const py::dict& reading, const py::dict& options,
                         const py::object& missing, const std::optional<double>& no_data, const CallOptions& call) {
    const OpenOptions open = open_options_of(reading);
    const MissingPolicy policy = missing_of(missing, no_data);
    const std::shared_ptr<VolumeReader> reader = open_volume(volume, open);
    BuildOptions build = build_options_of(options, reader->info(), policy);
    build.time_step = open.time_step;
    return built(path, reader, build, call);
}

/// Copies an array that Python has read into memory of C++. Called without the interpreter.
class SlabsOfPython {
public:
    SlabsOfPython(const py::function& read, ValueType type) : read_(keep_alive(read)), type_(type) {}

    void operator()(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) const {
        const py::gil_scoped_acquire acquired;
        const py::array slab = py::array::ensure((*read_)(z_begin, z_end), py::array::c_style);
        if (!slab || !slab.dtype().equal(dtype_of(type_)) || static_cast<std::size_t>(slab.nbytes()) != out.size()) {
            PyErr_Clear();
            throw Error(ErrorKind::input, {.where = "slices " + std::to_string(z_begin) + " to " + std::to_string(z_end),
                                           .what = "the array that was read has another shape or type than the volume",
                                           .next = "return the slices z_begin to z_end - 1 in the type of the whole"});
        }
        std::memcpy(out.data(), slab.data(), out.size());
    }

private:
    std::shared_ptr<const py::object> read_;
    ValueType type_;
};

/// shape: (z, y, x); read(z_begin, z_end): an array of these slices.
py::dict build_from_slabs(const std::string& path, const Shape& shape, const py::dtype& dtype, const py::function& read,
                          const py::dict& geometry, const std::string& value_unit, const py::dict& options, const py::object& missing,
                          const std::optional<double>& no_data, const CallOptions& call) {
    const std::optional<ValueType> type = type_of(dtype);
    if (!type || shape.size() != 3) throw Error(ErrorKind::usage, {.what = "slabs need three axes and one of the eight types"});
    VolumeInfo info;
    info.path = "array", info.format = "memory", info.encoding = "raw";
    info.type = *type, info.value_unit = value_unit;
    info.extent = {.rank = 3, .size = {shape[2], shape[1], shape[0]}};
    info.geometry = geometry_of(geometry);
    const std::shared_ptr<VolumeReader> reader = slab_reader(info, SlabsOfPython(read, *type));
    const BuildOptions build = build_options_of(options, info, missing_of(missing, no_data));
    return built(path, reader, build, call);
}

/// The same from memory that is there, with the interpreter released throughout.
py::dict build_from_volume(const std::string& path, const std::shared_ptr<Volume>& volume, const py::dict& options,
                           const py::object& missing, const std::optional<double>& no_data, const CallOptions& call) {
    const std::int64_t slice = volume->info.extent.slice() * static_cast<std::int64_t>(size_of(volume->info.type));
    const std::shared_ptr<VolumeReader> reader = slab_reader(volume->info, [=](std::int64_t z, std::int64_t end, std::span<std::byte> out) {
        const Volume& from = *volume;
        std::copy(from.bytes.begin() + z * slice, from.bytes.begin() + end * slice, out.begin());
    });
    const BuildOptions build = build_options_of(options, volume->info, missing_of(missing, no_data));
    return built(path, reader, build, call);
}

}  // namespace

void add_stores(py::module_& module) {
    module.def("is_store", &is_atlas, py::arg("path"));
    module.def("min_memory", [] { return kMinMemory; });
    module.def("store_polarities", [](const std::string& path) { return name_of(Atlas(path).polarities()); });
    module.def("build_from_file", &build_from_file, py::arg("path"), py::arg("volume"), py::arg("reading"), py::arg("options"),
               py::arg("missing"), py::arg("no_data"), py::arg("call"));
    module.def("build_from_slabs", &build_from_slabs, py::arg("path"), py::arg("shape"), py::arg("dtype"), py::arg("read"),
               py::arg("geometry"), py::arg("value_unit"), py::arg("options"), py::arg("missing"), py::arg("no_data"), py::arg("call"));
    module.def("build_from_volume", &build_from_volume, py::arg("path"), py::arg("volume"), py::arg("options"), py::arg("missing"),
               py::arg("no_data"), py::arg("call"));
}

}  // namespace isoatlas::python
