// Words of Python for choices of C++, and the other way round.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <isoatlas/error.h>
#include <isoatlas/selection.h>
#include <isoatlas/surface.h>
#include <isoatlas/volume.h>

namespace isoatlas::python {

/// One of some words. Throws Error{usage} that names the argument.
template <class Choice, std::size_t count>
Choice choice_of(std::string_view argument, std::string_view word, const std::array<std::pair<const char*, Choice>, count>& words) {
    std::string expected;
    for (const auto& [name, choice] : words) {
        if (word == name) return choice;
        expected += (expected.empty() ? "'" : ", '") + std::string(name) + "'";
    }
    throw Error(
        ErrorKind::usage,
        {.what = std::string(argument) + " cannot be '" + std::string(word) + "'", .expected = expected, .next = "use one of them"});
}

[[nodiscard]] Interpolant interpolant_of(std::string_view word);
[[nodiscard]] Polarity polarity_of(std::string_view word);
[[nodiscard]] Boundary boundary_of(std::string_view word);
[[nodiscard]] SurfaceStyle style_of(std::string_view word);
[[nodiscard]] ShellChoice shell_of(std::string_view word);
[[nodiscard]] PointSpace point_space_of(std::string_view word);

/// What a volume is: keys as in the JSON documents of the command line.
[[nodiscard]] pybind11::dict dict_of(const VolumeInfo& info);
/// spacing, origin, unit: in the order x, y, z; unset keys leave what is there.
[[nodiscard]] Geometry geometry_of(const pybind11::dict& geometry);
/// Options of the reader of a volume file: the members of OpenOptions.
[[nodiscard]] OpenOptions open_options_of(const pybind11::dict& options);
/// missing: None, "below", "above" or a number; no_data: None or a number.
[[nodiscard]] MissingPolicy missing_of(const pybind11::object& missing, const std::optional<double>& no_data);
/// The members of Selection: stored values.
[[nodiscard]] Selection selection_of(const pybind11::dict& given);

}  // namespace isoatlas::python
