#include "words.h"

#include <cmath>

#include <isoatlas/polarity.h>
#include <isoatlas/units.h>

namespace py = pybind11;

namespace isoatlas::python {
namespace {

template <class Value>
void take(const py::dict& from, const char* key, std::optional<Value>& to) {
    if (from.contains(key) && !from[key].is_none()) to = from[key].cast<Value>();
}

template <class Value>
void take(const py::dict& from, const char* key, Value& to) {
    if (from.contains(key) && !from[key].is_none()) to = from[key].cast<Value>();
}

ValueType value_type_of_word(const std::string& word) {
    for (int i = 0; i < 8; ++i) {
        if (word == name_of(static_cast<ValueType>(i))) return static_cast<ValueType>(i);
    }
    throw Error(ErrorKind::usage, {.what = "type cannot be '" + word + "'",
                                   .expected = "'uint8', 'int8', 'uint16', 'int16', 'uint32', 'int32', 'float32', 'float64'",
                                   .next = "use one of them"});
}

void check_finite(const char* what, const Vec3& numbers, bool positive) {
    for (const double number : numbers) {
        if (std::isfinite(number) && (!positive || number > 0)) continue;
        throw Error(ErrorKind::usage, {.what = std::string(what) + " is not " + (positive ? "positive and finite" : "finite"),
                                       .expected = positive ? "three numbers above 0" : "three numbers",
                                       .next = "correct it, or leave it out"});
    }
}

}  // namespace

Interpolant interpolant_of(std::string_view word) {
    return choice_of("interpolant", word,
                     std::array{std::pair("trilinear", Interpolant::trilinear), std::pair("faces", Interpolant::faces)});
}
Polarity polarity_of(std::string_view word) {
    return choice_of("polarity", word, std::array{std::pair("high", Polarity::high), std::pair("low", Polarity::low)});
}
Boundary boundary_of(std::string_view word) {
    return choice_of("boundary", word, std::array{std::pair("closed", Boundary::closed), std::pair("open", Boundary::open)});
}
SurfaceStyle style_of(std::string_view word) {
    return choice_of("style", word, std::array{std::pair("compact", SurfaceStyle::compact), std::pair("full", SurfaceStyle::full)});
}
ShellChoice shell_of(std::string_view word) {
    return choice_of(
        "shell", word,
        std::array{std::pair("all", ShellChoice::all), std::pair("outer", ShellChoice::outer), std::pair("inner", ShellChoice::inner)});
}
PointSpace point_space_of(std::string_view word) {
    return choice_of(
        "space", word,
        std::array{std::pair("lps", PointSpace::lps), std::pair("ras", PointSpace::ras), std::pair("volume", PointSpace::volume)});
}

py::dict dict_of(const VolumeInfo& info) {
    py::dict dict;
    dict["path"] = info.path;
    dict["format"] = info.format;
    dict["encoding"] = info.encoding;
    dict["type"] = name_of(info.type);
    dict["rank"] = info.extent.rank;
    py::list dims;
    for (int axis = 0; axis < info.extent.rank; ++axis) dims.append(info.extent.size[static_cast<std::size_t>(axis)]);
    dict["dims"] = dims;
    dict["spacing"] = info.geometry.spacing;
    dict["origin"] = info.geometry.origin;
    dict["direction"] = info.geometry.direction;
    if (!info.geometry.coordinates[0].empty()) dict["coordinates"] = info.geometry.coordinates;
    dict["space"] = info.geometry.space;
    dict["unit"] = info.geometry.unit;
    dict["measure_unit"] = measure_unit_name(info.geometry, info.extent.rank);
    dict["value_unit"] = info.value_unit;
    dict["slope"] = info.calibration.slope;
    dict["intercept"] = info.calibration.intercept;
    dict["gaussian"] = info.gaussian;
    dict["polarity"] = name_of(isoatlas::polarity_of(info));
    dict["notes"] = info.notes;
    return dict;
}

Geometry geometry_of(const py::dict& geometry) {
    Geometry result;
    take(geometry, "spacing", result.spacing);
    take(geometry, "origin", result.origin);
    take(geometry, "direction", result.direction);
    take(geometry, "space", result.space);
    take(geometry, "unit", result.unit);
    result.unit = unit_name(result.unit);
    check_finite("spacing", result.spacing, true);
    check_finite("origin", result.origin, false);
    for (const Vec3& row : result.direction) check_finite("direction", row, false);
    return result;
}

OpenOptions open_options_of(const py::dict& options) {
    OpenOptions open;
    take(options, "dims", open.dims);
    std::optional<std::string> type;
    take(options, "type", type);
    if (type) open.type = value_type_of_word(*type);
    take(options, "big_endian", open.big_endian);
    take(options, "skip_bytes", open.skip_bytes);
    take(options, "spacing", open.spacing);
    take(options, "origin", open.origin);
    take(options, "unit", open.unit);
    take(options, "value_unit", open.value_unit);
    take(options, "skip_rest", open.skip_rest);
    take(options, "follow_links", open.follow_links);
    take(options, "time_step", open.time_step);
    take(options, "channel", open.channel);
    take(options, "series", open.series);
    take(options, "level", open.level);
    if (open.unit) open.unit = unit_name(*open.unit);
    if (open.spacing) check_finite("spacing", *open.spacing, false);
    if (open.origin) check_finite("origin", *open.origin, false);
    return open;
}

MissingPolicy missing_of(const py::object& missing, const std::optional<double>& no_data) {
    MissingPolicy policy;
    policy.no_data = no_data;
    if (missing.is_none()) return policy;
    if (py::isinstance<py::str>(missing)) {
        using Action = MissingPolicy::Action;
        policy.action = choice_of("missing", missing.cast<std::string>(),
                                  std::array{std::pair("below", Action::below), std::pair("above", Action::above)});
        return policy;
    }
    policy.action = MissingPolicy::Action::replace;
    policy.value = missing.cast<double>();
    return policy;
}

Selection selection_of(const py::dict& given) {
    Selection chosen;
    const auto number = [&](const char* key) { return given.contains(key) ? given[key].cast<double>() : 0.0; };
    if (given.contains("keep")) chosen.keep = given["keep"].cast<std::int64_t>();
    if (given.contains("top_percent")) chosen.top_percent = given["top_percent"].cast<double>();
    chosen.min_voxels = number("min_voxels"), chosen.min_measure = number("min_measure");
    chosen.min_persistence = number("min_persistence"), chosen.min_hypervolume = number("min_hypervolume");
    return chosen;
}

}  // namespace isoatlas::python
