#include "errors.h"

#include <exception>
#include <new>
#include <utility>

#include <pybind11/pybind11.h>

#include <isoatlas/error.h>

#include "call.h"

namespace py = pybind11;

namespace isoatlas::python {
namespace {

const char* class_of(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::usage:
        case ErrorKind::input: return "InputError";
        case ErrorKind::unsupported: return "UnsupportedError";
        case ErrorKind::resource: return "ResourceError";
        case ErrorKind::not_found: return "NotFoundError";
        case ErrorKind::verification: return "VerificationError";
        case ErrorKind::cancelled: return "Cancelled";
        case ErrorKind::internal: break;
    }
    return "InternalError";
}

/// File names need not be UTF-8.
py::str text_of(const std::string& text) {
    return py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace"));
}

void raise(ErrorKind kind, const ErrorText& text) {
    const py::object errors = py::module_::import("isoatlas.errors");
    const py::object error =
        errors.attr("from_parts")(class_of(kind), text_of(text.file), text_of(text.where), text_of(text.what), text_of(text.expected),
                                  text_of(text.next), name_of(text.reason), text_of(text.value));
    PyErr_SetObject(py::type::handle_of(error).ptr(), error.ptr());
}

}  // namespace

void translate_exceptions() {
    py::register_local_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Error& error) {
            raise(error.kind(), error.text());
        } catch (const std::bad_alloc&) {
            raise(ErrorKind::resource, {.what = "not enough memory",
                                        .next = "use a smaller part of the volume, or a memory budget",
                                        .reason = Reason::not_enough_memory});
        }
    });
}

}  // namespace isoatlas::python
