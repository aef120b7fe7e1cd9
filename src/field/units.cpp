#include "isoatlas/units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace isoatlas {
namespace {

constexpr std::string_view kMicro = "\xc2\xb5m", kGreekMicro = "\xce\xbcm", kAngstrom = "\xc3\x85";

/// Lower-case names of headers and the one name for each.
constexpr std::array<std::pair<std::string_view, std::string_view>, 40> kNames{{
    {"um", kMicro},
    {"micron", kMicro},
    {"microns", kMicro},
    {"micrometer", kMicro},
    {"micrometers", kMicro},
    {"micrometre", kMicro},
    {"micrometres", kMicro},
    {"micro", kMicro},
    {"millimeter", "mm"},
    {"millimeters", "mm"},
    {"millimetre", "mm"},
    {"millimetres", "mm"},
    {"mm", "mm"},
    {"centimeter", "cm"},
    {"centimeters", "cm"},
    {"centimetre", "cm"},
    {"centimetres", "cm"},
    {"cm", "cm"},
    {"nanometer", "nm"},
    {"nanometers", "nm"},
    {"nanometre", "nm"},
    {"nanometres", "nm"},
    {"nm", "nm"},
    {"meter", "m"},
    {"meters", "m"},
    {"metre", "m"},
    {"metres", "m"},
    {"kilometer", "km"},
    {"kilometre", "km"},
    {"km", "km"},
    {"picometer", "pm"},
    {"picometre", "pm"},
    {"angstrom", kAngstrom},
    {"angstroms", kAngstrom},
    {"pixel", ""},
    {"pixels", ""},
    {"px", ""},
    {"voxel", ""},
    {"voxels", ""},
    {"none", ""},
}};

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string lower_ascii(std::string_view text) {
    std::string small(text);
    for (char& c : small) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return small;
}

bool has_even_unit_steps(const Geometry& geometry) {
    return geometry.spacing == Vec3{1, 1, 1} && std::ranges::all_of(geometry.coordinates, [](const auto& axis) { return axis.empty(); });
}

std::string number_text(double value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string vector_text(const Vec3& v, int rank, const char* between) {
    std::string text;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(rank); ++axis) text += (axis > 0 ? between : "") + number_text(v[axis]);
    return text;
}

void note(VolumeInfo& info, const std::string& what, const std::string& given, const std::string& before) {
    info.notes.push_back(what + " " + (given.empty() ? "none" : given) + " as given, instead of " + (before.empty() ? "none" : before));
}

void correct_spacing(VolumeInfo& info, const Vec3& spacing) {
    Geometry& geometry = info.geometry;
    for (int axis = 0; axis < info.extent.rank; ++axis) {
        const double length = spacing[static_cast<std::size_t>(axis)];
        if (std::isfinite(length) && length != 0) continue;
        throw Error(ErrorKind::usage, {.file = info.path,
                                       .what = "the spacing has an axis whose samples are no distance apart",
                                       .expected = "numbers other than 0",
                                       .next = "correct the spacing, or omit it",
                                       .reason = Reason::zero_spacing});
    }
    const bool was_even = std::ranges::all_of(geometry.coordinates, [](const auto& axis) { return axis.empty(); });
    const Geometry before = geometry;
    if (!was_even) {
        geometry.origin = to_physical(geometry, {0, 0, 0});
        geometry.coordinates = {};
    }
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(info.extent.rank); ++axis) {
        geometry.spacing[axis] = std::abs(spacing[axis]);
        for (Vec3& row : geometry.direction) {
            if (spacing[axis] < 0) row[axis] = 0 - row[axis];  // keeps zeros positive
        }
    }
    if (geometry == before) return;
    note(info, "spacing", vector_text(spacing, info.extent.rank, " x "),
         was_even ? vector_text(before.spacing, info.extent.rank, " x ") : "uneven steps");
}

void correct_text(VolumeInfo& info, const char* what, std::string& text, const std::string& given) {
    if (text == given) return;
    note(info, what, given, text);
    text = given;
}

}  // namespace

std::string unit_name(std::string_view name) {
    const std::string_view word = trimmed(name);
    if (word == kMicro || word == kGreekMicro || word == "\\u00b5m" || word == "\\u03bcm" || word == "\\u00B5m" || word == "\\u03BCm")
        return std::string(kMicro);
    if (word == "\xe2\x84\xab" || word == "\xc3\xa5") return std::string(kAngstrom);  // the sign of the unit, the small letter
    const std::string small = lower_ascii(word);
    const auto* found = std::ranges::find(kNames, small, &std::pair<std::string_view, std::string_view>::first);
    return std::string(found == kNames.end() ? word : found->second);
}

std::string ascii_unit(std::string_view name) {
    const std::string unit = unit_name(name);
    if (unit == kMicro) return "um";
    return unit == kAngstrom ? "angstrom" : unit;
}

std::string length_unit_name(const Geometry& geometry) {
    if (!geometry.unit.empty()) return geometry.unit;
    return has_even_unit_steps(geometry) ? "voxels" : "units";
}

std::string measure_unit_name(const Geometry& geometry, int rank) {
    const std::string unit = length_unit_name(geometry);
    return unit == "voxels" && geometry.unit.empty() ? unit : unit + (rank == 2 ? "\xc2\xb2" : "\xc2\xb3");
}

void correct(VolumeInfo& info, const Corrections& corrections) {
    if (corrections.spacing) correct_spacing(info, *corrections.spacing);
    if (corrections.origin && to_physical(info.geometry, {0, 0, 0}) != *corrections.origin) {
        note(info, "origin", vector_text(*corrections.origin, info.extent.rank, ", "),
             vector_text(to_physical(info.geometry, {0, 0, 0}), info.extent.rank, ", "));
        if (!info.geometry.coordinates[0].empty()) {  // a rectilinear grid begins where its coordinates do
            for (std::vector<double>& axis : info.geometry.coordinates) {
                const double first = axis.empty() ? 0 : axis.front();
                for (double& place : axis) place -= first;
            }
        }
        info.geometry.origin = *corrections.origin;
    }
    if (corrections.unit) correct_text(info, "unit of length", info.geometry.unit, unit_name(*corrections.unit));
    if (corrections.value_unit) correct_text(info, "unit of values", info.value_unit, *corrections.value_unit);
}

}  // namespace isoatlas
