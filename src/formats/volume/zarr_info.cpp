#include "formats/volume/zarr_info.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/common/length_unit.h"
#include "formats/volume/axes.h"
#include "formats/volume/choose.h"
#include "formats/volume/sample_reader.h"
#include "formats/zarr/zarr_error.h"
#include "isoatlas/units.h"

namespace isoatlas {
namespace {

std::size_t place_of(int axis) { return static_cast<std::size_t>(axis); }

std::string short_time_unit(const std::string& unit) {
    constexpr std::pair<std::string_view, const char*> kUnits[] = {
        {"second", "s"}, {"millisecond", "ms"}, {"microsecond", "\xc2\xb5s"}, {"nanosecond", "ns"}, {"minute", "min"},
        {"hour", "h"},   {"day", "d"}};
    for (const auto& [name, symbol] : kUnits) {
        if (unit == name) return symbol;
    }
    return unit;
}

/// One unit for all axes: that of x, to which the others are converted.
void set_unit(const Multiscale& image, const ZarrAxes& axes, std::array<LevelScale, 3>& scales, VolumeInfo& info) {
    const std::string unit = unit_name(image.units[place_of(axes.space[0])]);
    for (std::size_t a = 1; a < 3; ++a) {
        if (axes.space[a] < 0) continue;
        const std::string other = unit_name(image.units[place_of(axes.space[a])]);
        if (other == unit) continue;
        const std::optional<double> metres = metres_in(other), of_x = metres_in(unit);
        if (!metres || !of_x) {
            info.notes.push_back("the axes have different units (" + unit + ", " + other + "): none is taken");
            return;
        }
        scales[a].scale *= *metres / *of_x, scales[a].translation *= *metres / *of_x;
    }
    info.geometry.unit = unit;
}

void set_geometry(const ZarrImage& image, const ZarrAxes& axes, VolumeInfo& info) {
    if (!image.multiscale) return;
    const std::vector<LevelScale>& of_axes = image.multiscale->levels[image.level].scales;
    if (of_axes.empty()) {
        info.notes.emplace_back("the size of the samples is not given: 1 was assumed");
        return;
    }
    std::array<LevelScale, 3> scales{};
    for (std::size_t a = 0; a < 3; ++a) {
        if (axes.space[a] >= 0) scales[a] = of_axes[place_of(axes.space[a])];
    }
    set_unit(*image.multiscale, axes, scales, info);
    for (std::size_t a = 0; a < 3; ++a) {
        if (axes.space[a] < 0) continue;
        set_axis_spacing(info, static_cast<int>(a), scales[a].scale);
        if (std::isfinite(scales[a].translation)) info.geometry.origin[a] = scales[a].translation;
    }
}

void set_time(const std::string& path, const ZarrImage& image, const ZarrAxes& axes, const OpenOptions& options, VolumeInfo& info) {
    constexpr std::int64_t kMostTimes = 1 << 20;
    FileVolumes& volumes = info.volumes;
    const TimeStep step = choose_time_step(path, options, axes.time < 0 ? 1 : image.array.shape[place_of(axes.time)]);
    volumes.time_steps = step.count, volumes.time_step = step.index;
    if (axes.time < 0 || !image.multiscale || step.count > kMostTimes) return;
    const std::string& unit = image.multiscale->units[place_of(axes.time)];
    const std::vector<LevelScale>& scales = image.multiscale->levels[image.level].scales;
    if (scales.empty() || (unit.empty() && scales[place_of(axes.time)].scale == 1)) return;
    const auto [scale, translation] = scales[place_of(axes.time)];
    for (std::int64_t i = 0; i < step.count; ++i) volumes.times.push_back(scale * static_cast<double>(i) + translation);
    volumes.time_unit = short_time_unit(unit);
}

void set_channel(const KeyStore& store, const std::string& path, const ZarrImage& image, const ZarrAxes& axes, const OpenOptions& options,
                 VolumeInfo& info) {
    if (axes.channel < 0) return;
    constexpr std::int64_t kMostChannels = 65536;
    const std::int64_t count = image.array.shape[place_of(axes.channel)];
    if (count > kMostChannels)
        unsupported_zarr(store, image.array.path, "the array has " + std::to_string(count) + " channels", "at most 65536",
                         "write a part of the array");
    std::vector<std::string> names(static_cast<std::size_t>(count));
    if (image.multiscale) {
        const std::vector<std::string>& labels = image.multiscale->channels;
        std::copy_n(labels.begin(), std::min(labels.size(), names.size()), names.begin());
    }
    info.volumes.channel = choose_channel(path, options, names);
    if (count > 1 || !names[0].empty()) info.volumes.channels = std::move(names);
}

/// What isoatlas wrote besides OME-Zarr. Numbers that are none are left out.
void set_remainder(const Json& rest, VolumeInfo& info) {
    if (const std::string space = text_member(rest, "space"); !space.empty()) info.geometry.space = space;
    if (info.geometry.unit.empty()) info.geometry.unit = text_member(rest, "unit");
    info.value_unit = text_member(rest, "value_unit");
    const auto number = [](const Json& object, const char* name) {
        const Json* value = find_member(object, name);
        return value != nullptr && value->is_number() ? value->get<double>() : std::nan("");
    };
    if (const Json* calibration = find_member(rest, "calibration"))
        set_calibration(info, number(*calibration, "slope"), number(*calibration, "intercept"));
    const Json* direction = find_member(rest, "direction");
    Mat3 columns{};
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t a = 0; a < 3; ++a) {
            if (direction == nullptr || !direction->is_array() || direction->size() != 3) return;
            const Json& of_row = (*direction)[row];
            if (!of_row.is_array() || of_row.size() != 3 || !of_row[a].is_number()) return;
            columns[a][row] = of_row[a].get<double>();
        }
    }
    for (const Vec3& column : columns) {
        constexpr double kRounding = 1e-6;
        const double length = std::hypot(column[0], column[1], column[2]);
        if (!(std::abs(length - 1) < kRounding)) return;
    }
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t row = 0; row < 3; ++row) info.geometry.direction[row][a] = columns[a][row];
    }
    require_frame(info);
}

/// What xarray writes beside an array of its own.
void set_values(const ZarrImage& image, VolumeInfo& info) {
    const Json& attributes = image.array.attributes;
    if (image.multiscale) return;
    const auto number = [&](const char* name, double otherwise) {
        const Json* value = find_member(attributes, name);
        return value != nullptr && value->is_number() ? value->get<double>() : otherwise;
    };
    if (find_member(attributes, "scale_factor") != nullptr || find_member(attributes, "add_offset") != nullptr)
        set_calibration(info, number("scale_factor", 1), number("add_offset", 0));
    info.value_unit = text_member(attributes, "units");
}

}  // namespace

ZarrAxes axes_of(const KeyStore& store, const ZarrImage& image) {
    if (image.multiscale) return image.multiscale->axes;
    if (const std::optional<ZarrAxes> named = axes_of_names(image.array.axis_names)) return *named;
    const std::optional<ZarrAxes> placed = image.array.rank() <= 4 ? axes_of_rank(image.array.rank()) : std::nullopt;
    if (placed) return *placed;
    unsupported_zarr(store, image.array.path, "the array has " + std::to_string(image.array.rank()) + " axes",
                     "2, 3, or 4 with time slowest, or axes named t, c, z, y and x", "write a part of the array, or name its axes");
}

Index3 size_of_level(const ZarrArray& array, const ZarrAxes& axes) {
    Index3 size{1, 1, 1};
    for (std::size_t a = 0; a < 3; ++a) {
        if (axes.space[a] >= 0) size[a] = array.shape[place_of(axes.space[a])];
    }
    return size;
}

VolumeInfo zarr_info(const KeyStore& store, const std::string& path, const ZarrImage& image, const ZarrAxes& axes,
                     const OpenOptions& options) {
    const ZarrArray& array = image.array;
    VolumeInfo info;
    info.path = path;
    info.format = image.multiscale ? "OME-Zarr" : "Zarr";
    info.encoding = array.encoding;
    info.type = array.type.type;
    info.big_endian = array.type.big_endian && array.type.kind == ZarrType::Kind::same;
    info.extent.size = size_of_level(array, axes);
    info.extent.rank = axes.rank();
    if (image.multiscale) info.description = image.multiscale->name;
    if (image.multiscale && info.extent.rank == 3 && info.extent.size[2] == 1) {
        info.extent.rank = 2;
        info.notes.emplace_back("the image has a single slice: read as a 2D image");
    }
    static_cast<void>(sample_bytes(path, info.extent, info.type));  // rejects sizes that do not fit
    if (array.type.kind == ZarrType::Kind::half) info.notes.emplace_back("samples of 16 bits in floating point are read as float32");
    if (array.type.wide != WideInteger::none) info.notes.push_back(note_of(array.type.wide));
    if (array.type.kind == ZarrType::Kind::boolean) info.notes.emplace_back("booleans are read as 0 and 1 of type uint8");
    if (image.multiscale && image.multiscale->is_one_of_many)
        info.notes.emplace_back("the group has several images (multiscales); the first is read");
    set_time(path, image, axes, options, info);
    set_channel(store, path, image, axes, options, info);
    set_geometry(image, axes, info);
    set_values(image, info);
    if (image.multiscale && image.multiscale->remainder.is_object()) set_remainder(image.multiscale->remainder, info);
    info.volumes.levels = image.levels;
    info.volumes.level = image.levels.empty() ? 0 : static_cast<std::int64_t>(image.level);
    return info;
}

}  // namespace isoatlas
