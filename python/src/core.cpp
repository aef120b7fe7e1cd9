#include "core.h"

#include <isoatlas/array.h>
#include <isoatlas/version.h>

#include "addresses.h"
#include "call.h"
#include "errors.h"

namespace py = pybind11;

namespace isoatlas::python {

void add_calls(py::module_& module) {
    py::class_<CallOptions>(module, "Call")
        .def(py::init([](int threads, py::object progress) { return CallOptions{threads, std::move(progress)}; }), py::arg("threads") = 0,
             py::arg("progress") = py::none());
    py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_abandoned_calls));
    module.def("trim_memory_pool", &trim_memory_pool);
}

}  // namespace isoatlas::python

PYBIND11_MODULE(_core, module) {
    using namespace isoatlas::python;
    module.attr("version") = ISOATLAS_VERSION;
    translate_exceptions();
    read_addresses();
    add_calls(module);
    add_volumes(module);
    add_surfaces(module);
    add_sources(module);
    add_tables(module);
    add_trees(module);
    add_stores(module);
    add_simplified(module);
    add_names(module);
}
