// Arrays of numpy: views of results without a copy, volumes around arrays without a copy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>

#include <isoatlas/volume.h>

namespace isoatlas::python {

using Shape = std::vector<pybind11::ssize_t>;

/// (z, y, x), or (y, x) of 2D.
[[nodiscard]] Shape shape_of(const Extent& extent);
/// Of the samples, in host byte order.
[[nodiscard]] pybind11::dtype dtype_of(ValueType type);
/// nullopt: not one of the eight types in host byte order.
[[nodiscard]] std::optional<ValueType> type_of(const pybind11::dtype& dtype);
/// A shape of 2 or 3 numbers. Throws Error{input}.
[[nodiscard]] Extent extent_of(const pybind11::array& array);

/// A volume whose samples are those of the array, which it keeps alive. The array is C-contiguous and aligned, of one of the eight types.
[[nodiscard]] Volume borrow_array(const pybind11::array& array, const Geometry& geometry);

/// Elements of one row of a table of numbers.
template <class T>
struct RowOf {
    using Number = T;
    static constexpr pybind11::ssize_t kLength = 0;
};
template <class T, std::size_t length>
struct RowOf<std::array<T, length>> {
    using Number = T;
    static constexpr pybind11::ssize_t kLength = static_cast<pybind11::ssize_t>(length);
};

/// A view of a vector (n), or of a vector of rows (n, k). owner: keeps it alive.
template <class Vector>
pybind11::array view_of(Vector& vector, pybind11::handle owner) {
    using Row = RowOf<std::remove_cv_t<typename Vector::value_type>>;
    Shape shape{static_cast<pybind11::ssize_t>(vector.size())};
    if (Row::kLength > 0) shape.push_back(Row::kLength);
    const auto* numbers = reinterpret_cast<const typename Row::Number*>(vector.data());
    return pybind11::array(pybind11::dtype::of<typename Row::Number>(), shape, numbers, owner);
}

/// The vector itself as an array; nothing is copied. shape: of a vector of numbers; empty: as view_of().
template <class Vector>
pybind11::array moved_array(Vector&& vector, Shape shape = {}) {
    auto* kept = new std::decay_t<Vector>(std::forward<Vector>(vector));
    const pybind11::capsule owner(kept, [](void* memory) { delete static_cast<std::decay_t<Vector>*>(memory); });
    if (shape.empty()) return view_of(*kept, owner);
    using Number = typename RowOf<typename std::decay_t<Vector>::value_type>::Number;
    return pybind11::array(pybind11::dtype::of<Number>(), shape, reinterpret_cast<const Number*>(kept->data()), owner);
}

}  // namespace isoatlas::python
