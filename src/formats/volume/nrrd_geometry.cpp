#include "formats/volume/nrrd_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "formats/common/text.h"
#include "formats/volume/axes.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMaxAxes = 16;  // NRRD_DIM_MAX of the format

bool is_position(const std::string& kind) {
    static constexpr std::array<std::string_view, 6> kKinds = {"domain", "space", "time", "???", "none", ""};
    return std::find(kKinds.begin(), kKinds.end(), kind) != kKinds.end();
}

std::vector<std::string> axis_kinds(const NrrdHeader& header, std::size_t dimension) {
    if (!header.has("kinds")) return std::vector<std::string>(dimension);
    std::vector<std::string> kinds = header.words("kinds", dimension);
    for (std::string& kind : kinds) kind = lower(kind);
    return kinds;
}

std::vector<std::int64_t> axis_sizes(const NrrdHeader& header) {
    if (!header.has("dimension")) header.fail(ErrorKind::input, "dimension", "is missing", "the number of axes");
    if (!header.has("sizes")) header.fail(ErrorKind::input, "sizes", "is missing", "one size per axis");
    const std::int64_t dimension = header.integers("dimension", 1)[0];
    if (dimension < 1 || dimension > static_cast<std::int64_t>(kMaxAxes)) {
        header.fail(ErrorKind::input, "dimension", "is " + std::to_string(dimension), "1 to 16");
    }
    std::vector<std::int64_t> sizes = header.integers("sizes", static_cast<std::size_t>(dimension));
    for (const std::int64_t size : sizes) {
        if (size < 1) header.fail(ErrorKind::input, "sizes", "an axis has " + std::to_string(size) + " samples", "at least 1");
    }
    return sizes;
}

[[noreturn]] void several_values(const NrrdHeader& header, std::size_t axis, const std::string& kind) {
    const std::string number = std::to_string(axis);
    header.fail(ErrorKind::unsupported, "kinds", "axis " + number + " (" + kind + ") holds several values per sample",
                "one value per sample", "extract one component, for example: unu slice -a " + number + " -p 0 -i IN.nrrd -o OUT.nrrd");
}

std::string space_name(const NrrdHeader& header) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kNames = {{{"left-posterior-superior", "LPS"},
                                                                                              {"lps", "LPS"},
                                                                                              {"right-anterior-superior", "RAS"},
                                                                                              {"ras", "RAS"},
                                                                                              {"left-anterior-superior", "LAS"},
                                                                                              {"las", "LAS"},
                                                                                              {"left-posterior-superior-time", "LPS"},
                                                                                              {"lpst", "LPS"},
                                                                                              {"right-anterior-superior-time", "RAS"},
                                                                                              {"rast", "RAS"},
                                                                                              {"left-anterior-superior-time", "LAS"},
                                                                                              {"last", "LAS"}}};
    const std::string text = header.text("space");
    for (const auto& [name, short_name] : kNames) {
        if (lower(text) == name) return std::string(short_name);
    }
    return text.empty() ? "unknown" : printable(text);
}

/// Units of lengths: those of the axes used, when they agree.
std::string length_unit(const NrrdHeader& header, const NrrdAxes& axes, std::vector<std::string>& notes) {
    std::vector<std::string> units;
    if (header.has("space units")) {
        const std::vector<std::string_view> found = split_words(header.fields.at("space units"));
        units = header.words("space units", found.size());
        units.resize(std::min(units.size(), axes.spatial.size()));
    } else if (header.has("units")) {
        const std::vector<std::string> all = header.words("units", axes.sizes.size());
        for (const std::size_t axis : axes.spatial) units.push_back(all[axis]);
    }
    if (units.empty()) return {};
    if (std::any_of(units.begin(), units.end(), [&](const std::string& unit) { return unit != units[0]; })) {
        notes.push_back("the axes have different units; lengths are reported without a unit");
        return {};
    }
    return units[0] == "???" ? std::string() : units[0];
}

Vec3 three(const std::vector<double>& vector) {
    Vec3 result{};
    std::copy_n(vector.begin(), std::min<std::size_t>(3, vector.size()), result.begin());
    return result;
}

/// space directions and space origin: the axes are vectors of an oriented space.
void read_oriented(const NrrdHeader& header, const NrrdAxes& axes, VolumeInfo& info) {
    if (header.has("spacings") || header.has("axis mins") || header.has("axis maxs")) {
        header.fail(ErrorKind::input, "space directions", "spacings or axis mins are given as well", "one description of the axes",
                    "delete 'space directions' or the other fields from the header");
    }
    const auto directions = header.vectors("space directions", axes.sizes.size());
    std::size_t space_dimension = 0;
    for (std::size_t i = 0; i < axes.spatial.size(); ++i) {
        const auto& direction = directions[axes.spatial[i]];
        if (!direction) continue;
        if (direction->size() < 2 || direction->size() > 4 || (space_dimension != 0 && direction->size() != space_dimension)) {
            header.fail(ErrorKind::input, "space directions", "vectors of different or odd lengths", "2 or 3 components each");
        }
        space_dimension = direction->size();
        set_axis_step(info, static_cast<int>(i), three(*direction));
    }
    if (header.has("space origin")) {
        const auto origin = header.vectors("space origin", 1)[0];
        if (origin && std::all_of(origin->begin(), origin->end(), [](double x) { return std::isfinite(x); })) {
            info.geometry.origin = three(*origin);
        } else {
            info.notes.push_back("the space origin is not a number: (0, 0, 0) was assumed");
        }
    }
    if (info.extent.rank == 2 && space_dimension >= 3) complete_normal(info.geometry);
    require_frame(info);
}

/// spacings, axis mins and axis maxs: each axis by itself. The position of a cell-centred sample is the middle of its cell.
void read_per_axis(const NrrdHeader& header, const NrrdAxes& axes, VolumeInfo& info) {
    const std::size_t dimension = axes.sizes.size();
    const auto values = [&](const std::string& field) {
        return header.has(field) ? header.numbers(field, dimension) : std::vector<double>(dimension, std::nan(""));
    };
    const std::vector<double> spacings = values("spacings"), mins = values("axis mins"), maxs = values("axis maxs");
    const std::vector<std::string> centers =
        header.has("centers") ? header.words("centers", dimension) : std::vector<std::string>(dimension);
    for (std::size_t i = 0; i < axes.spatial.size(); ++i) {
        const std::size_t axis = axes.spatial[i];
        const bool cells = lower(centers[axis]) == "cell";
        const double steps = static_cast<double>(cells ? axes.sizes[axis] : axes.sizes[axis] - 1);
        double spacing = spacings[axis];
        if (std::isnan(spacing) && std::isfinite(mins[axis]) && std::isfinite(maxs[axis]) && steps > 0)
            spacing = (maxs[axis] - mins[axis]) / steps;
        if (!std::isnan(spacing)) set_axis_spacing(info, static_cast<int>(i), spacing);  // NaN: "unknown" in NRRD
        if (std::isfinite(mins[axis])) info.geometry.origin[i] = mins[axis] + (cells && std::isfinite(spacing) ? spacing / 2 : 0);
    }
    if (header.has("space origin")) {
        const auto origin = header.vectors("space origin", 1)[0];
        if (origin) info.geometry.origin = three(*origin);
    }
}

}  // namespace

NrrdAxes choose_nrrd_axes(const NrrdHeader& header, std::vector<std::string>& notes) {
    NrrdAxes axes{.spatial = {}, .sizes = axis_sizes(header)};
    const std::vector<std::string> kinds = axis_kinds(header, axes.sizes.size());
    std::vector<std::size_t> kept;
    for (std::size_t axis = 0; axis < axes.sizes.size(); ++axis) {
        if (is_position(kinds[axis])) {
            kept.push_back(axis);
        } else if (kinds[axis] == "list" && axis + 1 == axes.sizes.size() && kept.size() == 3) {
            kept.push_back(axis);  // a list of volumes is a series as well
        } else if (axes.sizes[axis] != 1) {
            several_values(header, axis, in_quotes(kinds[axis]));
        } else {
            notes.push_back("axis " + std::to_string(axis) + " (" + printable(kinds[axis]) + ") has one entry and was dropped");
        }
    }
    while (kept.size() > 4 && axes.sizes[kept.back()] == 1) kept.pop_back();
    if (kept.size() < 2 || kept.size() > 4) {
        header.fail(ErrorKind::unsupported, "dimension", "the file has " + std::to_string(kept.size()) + " axes",
                    "2, 3, or 4 with time last", "slice it, for example: unu slice -a AXIS -p POSITION -i IN.nrrd -o OUT.nrrd");
    }
    if (kept.size() == 4) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (kinds[kept[i]] != "time") continue;
            header.fail(ErrorKind::unsupported, "kinds", "time is axis " + std::to_string(kept[i]), "time as the last axis",
                        "reorder the file: unu permute -p ORDER -i IN.nrrd -o OUT.nrrd");
        }
        axes.volumes = axes.sizes[kept[3]];
        kept.pop_back();
    }
    axes.spatial = std::move(kept);
    return axes;
}

void read_nrrd_geometry(const NrrdHeader& header, const NrrdAxes& axes, VolumeInfo& info) {
    info.geometry.space = space_name(header);
    info.geometry.unit = printable(length_unit(header, axes, info.notes));
    if (header.has("space directions")) {
        read_oriented(header, axes, info);
    } else {
        read_per_axis(header, axes, info);
    }
}

}  // namespace isoatlas
