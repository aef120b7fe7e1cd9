// The module isoatlas._serve: the server of the viewer, on a thread of its own.
#include <memory>
#include <string>
#include <thread>

#include <pybind11/pybind11.h>

#include <isoatlas/server.h>

#include "addresses.h"
#include "call.h"
#include "errors.h"
#include "source.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

/// A store behind a local address until it is closed. Made and ended with the interpreter held.
class Viewer {
public:
    Viewer(const std::string& store, int port, bool is_read_only)
        : atlas_(store), server_({.port = port, .is_read_only = is_read_only, .link = link_of_store(store)}) {
        server_.open(atlas_);
        thread_ = std::thread([this] { server_.run(); });
    }
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;
    ~Viewer() { close(); }

    void close() {
        if (!thread_.joinable()) return;
        server_.stop();
        thread_.join();
    }
    [[nodiscard]] std::string address() const { return server_.address(); }
    [[nodiscard]] std::string token() const { return server_.token(); }
    [[nodiscard]] std::string address_for_one_use() { return server_.address_for_one_use(); }
    [[nodiscard]] std::string address_for_one_frame() { return server_.address_for_one_frame(); }
    [[nodiscard]] std::string scene() const { return server_.scene(); }
    void set_scene(const std::string& text) { server_.set_scene(text); }

private:
    Atlas atlas_;
    Server server_;
    std::thread thread_;
};

}  // namespace
}  // namespace isoatlas::python

PYBIND11_MODULE(_serve, module) {
    using isoatlas::python::Viewer;
    py::module_::import("isoatlas._core");
    isoatlas::python::translate_exceptions();
    isoatlas::python::read_addresses();
    const auto released = py::call_guard<py::gil_scoped_release>();
    module.def("check_has_viewer", &isoatlas::check_has_viewer);
    py::class_<Viewer>(module, "Viewer")
        .def(py::init<const std::string&, int, bool>(), py::arg("store"), py::arg("port"), py::arg("is_read_only"), released)
        .def("close", &Viewer::close, released)
        .def_property_readonly("address", &Viewer::address)
        .def_property_readonly("token", &Viewer::token)
        .def("address_for_one_use", &Viewer::address_for_one_use, released)
        .def("address_for_one_frame", &Viewer::address_for_one_frame, released)
        .def("scene", &Viewer::scene, released)
        .def("set_scene", &Viewer::set_scene, py::arg("text"), released);
}
