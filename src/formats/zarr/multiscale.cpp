#include "formats/zarr/multiscale.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "formats/common/text.h"
#include "formats/zarr/zarr_error.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMostLevels = 64;
constexpr std::size_t kMostChannelNames = 65536;
constexpr const char* kDamagedImage = "the metadata of the image are damaged: write them again";

[[noreturn]] void bad_image(const KeyStore& store, const std::string& group, const std::string& what, const std::string& expected) {
    bad_zarr(store, group.empty() ? "multiscales" : group + ", multiscales", what, expected, kDamagedImage);
}

const Json* first_image(const Json& ome) {
    const Json* images = find_member(ome, "multiscales");
    return images != nullptr && images->is_array() && !images->empty() ? &(*images)[0] : nullptr;
}

struct NamedAxis {
    std::string name, type, unit;
};

std::vector<NamedAxis> named_axes(const Json& image) {
    std::vector<NamedAxis> axes;
    const Json* list = find_member(image, "axes");
    if (list == nullptr || !list->is_array()) return axes;
    for (const Json& axis : *list) {
        NamedAxis named{.name = axis.is_string() ? axis.get<std::string>() : text_member(axis, "name"),
                        .type = text_member(axis, "type"),
                        .unit = text_member(axis, "unit")};
        if (named.type.empty()) {
            const std::string name = lower(named.name);
            named.type = name == "t" || name == "time" ? "time" : name == "x" || name == "y" || name == "z" ? "space" : "channel";
        }
        axes.push_back(std::move(named));
    }
    return axes;
}

/// The axes of space: by the names x, y and z where they have these, else the last one is x.
void place_space(const std::vector<NamedAxis>& axes, const std::vector<int>& space, ZarrAxes& placed) {
    std::array<int, 3> by_name{-1, -1, -1};
    for (const int axis : space) {
        const std::string name = lower(axes[static_cast<std::size_t>(axis)].name);
        if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') by_name[static_cast<std::size_t>(name[0] - 'x')] = axis;
    }
    const bool has_names = by_name[0] >= 0 && by_name[1] >= 0 && (space.size() == 2 || by_name[2] >= 0);
    for (std::size_t i = 0; i < space.size(); ++i) placed.space[i] = has_names ? by_name[i] : space[space.size() - 1 - i];
}

ZarrAxes placed_axes(const KeyStore& store, const std::string& group, const std::vector<NamedAxis>& axes) {
    ZarrAxes placed;
    std::vector<int> space;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        int& other = axes[i].type == "time" ? placed.time : placed.channel;
        if (axes[i].type == "space") {
            space.push_back(static_cast<int>(i));
        } else if (other >= 0) {
            unsupported_zarr(
                store, group,
                "the axes " + in_quotes(axes[static_cast<std::size_t>(other)].name) + " and " + in_quotes(axes[i].name) + " are alike",
                "one axis of time, one of channels, 2 or 3 of space", "write a part of the array that has no such axis");
        } else {
            other = static_cast<int>(i);
        }
    }
    if (space.size() < 2 || space.size() > 3)
        unsupported_zarr(store, group, "the image has " + std::to_string(space.size()) + " axes of space", "2 or 3");
    place_space(axes, space, placed);
    return placed;
}

/// Numbers of a transformation, one for each axis.
std::vector<double> numbers_of(const KeyStore& store, const std::string& group, const Json& transformation, const std::string& type,
                               std::size_t rank) {
    const Json* list = find_member(transformation, type.c_str());
    std::vector<double> numbers;
    if (list == nullptr && find_member(transformation, "path") != nullptr)
        unsupported_zarr(store, group, "a coordinate transformation is kept in an array", "numbers in the metadata");
    if (list == nullptr || !list->is_array()) bad_image(store, group, "a transformation has no numbers", "\"scale\" or \"translation\"");
    for (const Json& number : *list) numbers.push_back(number.is_number() ? number.get<double>() : std::nan(""));
    const bool is_sound = numbers.size() == rank && std::ranges::all_of(numbers, [](double n) { return std::isfinite(n); });
    if (!is_sound) bad_image(store, group, "a " + type + " is not valid", "a number for each axis");
    return numbers;
}

/// Applies "coordinateTransformations" of an object, if it has any.
void transform(const KeyStore& store, const std::string& group, const Json& object, std::size_t rank, std::vector<LevelScale>& scales) {
    const Json* list = find_member(object, "coordinateTransformations");
    if (list == nullptr || list->is_null()) return;
    if (!list->is_array()) bad_image(store, group, "\"coordinateTransformations\" is not valid", "a list");
    for (const Json& transformation : *list) {
        const std::string type = text_member(transformation, "type");
        if (type == "identity") continue;
        if (type != "scale" && type != "translation")
            unsupported_zarr(store, group, "the coordinate transformation " + in_quotes(type) + " is not supported",
                             "scale and translation");
        const std::vector<double> numbers = numbers_of(store, group, transformation, type, rank);
        scales.resize(rank);
        for (std::size_t axis = 0; axis < rank; ++axis) {
            LevelScale& of_axis = scales[axis];
            if (type == "translation") of_axis.translation += numbers[axis];
            if (type == "scale") of_axis.scale *= numbers[axis], of_axis.translation *= numbers[axis];
        }
    }
}

std::vector<std::string> channel_labels(const Json& ome) {
    std::vector<std::string> labels;
    const Json* omero = find_member(ome, "omero");
    const Json* channels = omero == nullptr ? nullptr : find_member(*omero, "channels");
    if (channels == nullptr || !channels->is_array() || channels->size() > kMostChannelNames) return labels;
    for (const Json& channel : *channels) labels.push_back(text_member(channel, "label"));
    return labels;
}

}  // namespace

std::vector<std::string> level_paths(const std::string& group, const Json& ome) {
    std::vector<std::string> paths;
    const Json* image = first_image(ome);
    const Json* datasets = image == nullptr ? nullptr : find_member(*image, "datasets");
    if (datasets == nullptr || !datasets->is_array()) return paths;
    for (const Json& dataset : *datasets) {
        if (paths.size() < kMostLevels) paths.push_back(join_key(group, text_member(dataset, "path")));
    }
    return paths;
}

std::optional<ZarrAxes> axes_of_names(const std::vector<std::string>& names) {
    ZarrAxes axes;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string name = lower(names[i]);
        int* place = name == "t" || name == "time"      ? &axes.time
                     : name == "c" || name == "channel" ? &axes.channel
                     : name == "x"                      ? &axes.space[0]
                     : name == "y"                      ? &axes.space[1]
                     : name == "z"                      ? &axes.space[2]
                                                        : nullptr;
        if (place == nullptr || *place >= 0) return std::nullopt;
        *place = static_cast<int>(i);
    }
    if (axes.space[0] < 0 || axes.space[1] < 0) return std::nullopt;
    return axes;
}

std::optional<ZarrAxes> axes_of_rank(std::size_t rank) {
    switch (rank) {
        case 2: return ZarrAxes{.space = {1, 0, -1}};
        case 3: return ZarrAxes{.space = {2, 1, 0}};
        case 4: return ZarrAxes{.time = 0, .space = {3, 2, 1}};
        case 5: return ZarrAxes{.time = 0, .channel = 1, .space = {4, 3, 2}};
        default: return std::nullopt;
    }
}

Multiscale read_multiscale(const KeyStore& store, const std::string& group, const Json& ome, std::size_t rank) {
    const Json* image = first_image(ome);
    if (image == nullptr) bad_image(store, group, "is not valid", "a list of images");
    Multiscale multiscale;
    multiscale.is_one_of_many = find_member(ome, "multiscales")->size() > 1;
    multiscale.name = text_member(*image, "name");
    const std::vector<NamedAxis> axes = named_axes(*image);
    if (axes.empty()) {  // version 0.1 and 0.2
        const std::optional<ZarrAxes> placed = axes_of_rank(rank);
        if (!placed) bad_image(store, group, "the axes are not named", "\"axes\"");
        multiscale.axes = *placed;
        multiscale.units.resize(rank);
    } else {
        if (axes.size() != rank)
            bad_image(store, group, "names " + std::to_string(axes.size()) + " axes of an array with " + std::to_string(rank),
                      "a name for each axis");
        multiscale.axes = placed_axes(store, group, axes);
        for (const NamedAxis& axis : axes) multiscale.units.push_back(axis.unit);
    }
    const std::vector<std::string> paths = level_paths(group, ome);
    if (paths.empty()) bad_image(store, group, "\"datasets\" is missing or empty", "the arrays of the image");
    for (std::size_t i = 0; i < paths.size(); ++i) {
        MultiscaleLevel level{.path = paths[i]};
        transform(store, group, (*find_member(*image, "datasets"))[i], rank, level.scales);
        transform(store, group, *image, rank, level.scales);
        multiscale.levels.push_back(std::move(level));
    }
    multiscale.channels = channel_labels(ome);
    if (const Json* remainder = find_member(ome, "isoatlas")) multiscale.remainder = *remainder;
    return multiscale;
}

}  // namespace isoatlas
