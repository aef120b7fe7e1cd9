// Volumes: samples in memory, around arrays of numpy, from files and generated.
#include <memory>
#include <string>

#include <isoatlas/filter.h>
#include <isoatlas/output.h>
#include <isoatlas/phantom.h>
#include <isoatlas/polarity.h>
#include <isoatlas/sink.h>
#include <isoatlas/volume.h>

#include "arrays.h"
#include "call.h"
#include "core.h"
#include "words.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

using Shared = std::shared_ptr<Volume>;

/// The samples, read-only: (z, y, x).
py::array samples_of(const py::object& self) {
    const auto& volume = self.cast<const Volume&>();
    const std::byte* first = std::as_const(volume.bytes).data();
    py::array samples(dtype_of(volume.info.type), shape_of(volume.info.extent), first, self);
    samples.attr("setflags")(py::arg("write") = false);
    return samples;
}

Shared borrowed(const py::array& array, const py::dict& geometry, const std::string& value_unit) {
    auto volume = std::make_shared<Volume>(borrow_array(array, geometry_of(geometry)));
    volume->info.value_unit = value_unit;
    return volume;
}

/// As a volume file with these samples would be read.
void complete(const Shared& volume, const py::object& missing, const std::optional<double>& no_data, const CallOptions& call) {
    const MissingPolicy policy = missing_of(missing, no_data);
    long_call(call, [=](const Context& context) { replace_missing(*volume, policy, context); });
}

Shared read(const std::string& path, const py::dict& options, const py::object& missing, const std::optional<double>& no_data,
            const CallOptions& call) {
    const OpenOptions open = open_options_of(options);
    const MissingPolicy policy = missing_of(missing, no_data);
    return long_call(call, [=](const Context& context) { return std::make_shared<Volume>(load_volume(path, open, policy, context)); });
}

Shared phantom(const std::string& name, const py::dict& options) {
    PhantomOptions chosen;
    for (const auto& [key, value] : options) {
        const auto word = key.cast<std::string>();
        if (word == "size") {
            chosen.size = value.cast<std::int64_t>();
        } else if (word == "seed") {
            chosen.seed = value.cast<std::uint64_t>();
        } else if (word == "genus") {
            chosen.genus = value.cast<std::int64_t>();
        } else if (word == "shells") {
            chosen.shells = value.cast<std::int64_t>();
        } else if (word == "noise") {
            chosen.noise = value.cast<double>();
        } else {
            chosen.quantise = value.cast<std::int64_t>();
        }
    }
    return released([&] { return std::make_shared<Volume>(make_phantom(name, chosen)); });
}

Shared shaped(const Shared& volume, const std::optional<SampleBox>& box, double sigma, const CallOptions& call) {
    return long_call(call, [=](const Context& context) {
        if (box && sigma > 0) return std::make_shared<Volume>(gaussian_filter(*volume, *box, sigma, context));
        if (box) return std::make_shared<Volume>(crop(*volume, *box));
        return std::make_shared<Volume>(gaussian_filter(*volume, sigma, context));
    });
}

std::optional<SampleBox> box_of(const std::optional<std::array<std::array<std::int64_t, 3>, 2>>& box) {
    if (!box) return std::nullopt;
    return SampleBox{{(*box)[0]}, {(*box)[1]}};
}

}  // namespace

void add_volumes(py::module_& module) {
    py::class_<Volume, Shared>(module, "Volume")
        .def(py::init(&borrowed), py::arg("array"), py::arg("geometry"), py::arg("value_unit") = "")
        .def_property_readonly("info", [](const Volume& volume) { return dict_of(volume.info); })
        .def_property_readonly("is_borrowed", [](const Volume& volume) { return volume.bytes.is_borrowed(); })
        .def_property_readonly("samples", &samples_of)
        .def("complete", &complete, py::arg("missing"), py::arg("no_data"), py::arg("call"))
        .def(
            "shaped",
            [](const Shared& volume, const std::optional<std::array<std::array<std::int64_t, 3>, 2>>& box, double sigma,
               const CallOptions& call) { return shaped(volume, box_of(box), sigma, call); },
            py::arg("box"), py::arg("sigma"), py::arg("call"))
        .def("negated", [](const Volume& volume) { return released([&] { return std::make_shared<Volume>(isoatlas::negated(volume)); }); })
        .def("write", [](const Volume& volume, const std::string& path) { released([&] { write_volume(path, volume); }); });
    module.def("read_volume", &read, py::arg("path"), py::arg("options"), py::arg("missing"), py::arg("no_data"), py::arg("call"));
    module.def("volume_info", [](const std::string& path, const py::dict& options) {
        return dict_of(open_volume(path, open_options_of(options))->info());
    });
    module.def("phantom", &phantom, py::arg("name"), py::arg("options"));
    module.def("phantoms", [] {
        py::list list;
        for (const PhantomDescription& one : phantoms()) list.append(py::make_tuple(one.name, one.summary, one.default_size));
        return list;
    });
}

}  // namespace isoatlas::python
