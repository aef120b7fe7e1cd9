#include "arrays.h"

#include <optional>
#include <string>

#include "call.h"

namespace py = pybind11;

namespace isoatlas::python {

Shape shape_of(const Extent& extent) {
    Shape shape;
    for (int axis = extent.rank - 1; axis >= 0; --axis) shape.push_back(extent.size[static_cast<std::size_t>(axis)]);
    return shape;
}

py::dtype dtype_of(ValueType type) {
    return visit_type(type, []<class T>(T) { return py::dtype::of<T>(); });
}

std::optional<ValueType> type_of(const py::dtype& dtype) {
    for (int i = 0; i < 8; ++i) {
        const auto type = static_cast<ValueType>(i);
        if (dtype.is(dtype_of(type)) || dtype.equal(dtype_of(type))) return type;
    }
    return std::nullopt;
}

Extent extent_of(const py::array& array) {
    const py::ssize_t rank = array.ndim();
    if (rank != 2 && rank != 3) {
        throw Error(ErrorKind::input, {.what = "the array has " + std::to_string(rank) + " axes",
                                       .expected = "3 axes (z, y, x), or 2 axes (y, x)",
                                       .next = "choose one volume of it, such as array[0]"});
    }
    Extent extent{.rank = static_cast<int>(rank), .size = {1, 1, 1}};
    for (py::ssize_t axis = 0; axis < rank; ++axis) {
        if (array.shape(axis) < 1) throw Error(ErrorKind::input, {.what = "the array is empty", .expected = "at least one sample"});
        extent.size[static_cast<std::size_t>(rank - 1 - axis)] = array.shape(axis);
    }
    return extent;
}

Volume borrow_array(const py::array& array, const Geometry& geometry) {
    const std::optional<ValueType> type = type_of(array.dtype());
    if (!type || (array.flags() & py::array::c_style) == 0)
        throw Error(ErrorKind::usage, {.what = "the array is not C-contiguous, or of another type"});
    const std::span<const std::byte> samples(static_cast<const std::byte*>(array.data()), static_cast<std::size_t>(array.nbytes()));
    return borrow_volume(extent_of(array), *type, samples, keep_alive(array), geometry);
}

}  // namespace isoatlas::python
