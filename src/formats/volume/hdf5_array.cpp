// Arrays of HDF5 files of any program, and those of NeXus, which have axes beside them.
#include <algorithm>
#include <deque>
#include <set>

#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/choose.h"
#include "formats/volume/hdf5_conventions.h"
#include "formats/volume/placed_axes.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMostObjects = 200'000, kLongestPath = 1000;

/// Dimensions with more than one sample.
std::size_t thick_dimensions(const Hdf5Array& array) {
    return static_cast<std::size_t>(std::ranges::count_if(array.dims, [](std::int64_t size) { return size > 1; }));
}
bool is_candidate(const Hdf5Array& array, std::size_t most) {
    const bool has_samples = std::ranges::find(array.dims, 0) == array.dims.end();
    const std::size_t thick = thick_dimensions(array);
    if (!has_samples || thick < 2 || thick > most) return false;
    return array.dims.size() > 3 || thick == array.dims.size();
}

std::vector<ErrorChoice> choices_of(const std::vector<Hdf5Array>& arrays) {
    std::vector<ErrorChoice> choices;
    for (const std::size_t most : {3U, 4U}) {  // those with time only where there are no others
        for (const Hdf5Array& array : arrays) {
            if (is_candidate(array, most)) choices.push_back({array.path, shape_of(array)});
        }
        if (!choices.empty()) break;
    }
    return choices;
}

[[noreturn]] void no_arrays(const std::string& path, const std::vector<Hdf5Array>& arrays) {
    const std::string others =
        first_of(arrays, [](const Hdf5Array& array) { return shown_name(array.path) + " (" + shape_of(array) + ")"; });
    throw Error(ErrorKind::unsupported, {.file = path,
                                         .what = "has no dataset of 2 or 3 dimensions with more than one sample along each" +
                                                 (others.empty() ? "" : "; it has " + others),
                                         .expected = "an array of numbers",
                                         .next = "name the dataset if it is one of these, FILE:/PATH, or reshape it"});
}

/// The group of NXdata that @default leads to, from a group on.
std::string default_data(const Hdf5File& file) {
    std::string group = "/";
    for (int step = 0; step < 16; ++step) {
        if (file.has_attribute(group, "signal")) return group;
        const std::string next = file.text(group, "default");
        if (next.empty() || file.kind(join_path(group, next)) != Hdf5File::Kind::group) return {};
        group = join_path(group, next);
    }
    return {};
}

/// The array that a group of NXdata shows; "": it is none.
std::string signal_of(const Hdf5File& file, const std::string& group) {
    const std::string signal = file.text(group, "signal");
    if (signal.empty() || file.kind(join_path(group, signal)) != Hdf5File::Kind::array) return {};
    return join_path(group, signal);
}

std::string hdf5_parent_of(const std::string& path) { return path.rfind('/') == 0 ? "/" : path.substr(0, path.rfind('/')); }

/// The array of a file that isoatlas wrote, also when it is one sample thick; "": it is none.
std::string own_array(const Hdf5File& file) {
    if (file.has_attribute("/", "signal") || file.has_attribute("/", "default")) return {};
    for (const char* path : {"/volume", "/labels"}) {
        if (file.kind(path) == Hdf5File::Kind::array && file.has_attribute(path, "gridSpacing")) return path;
    }
    return {};
}

/// Names of the axes of an array of NXdata, for each of its dimensions; empty: not of NXdata.
std::vector<std::string> nexus_axes(const Hdf5File& file, const Hdf5Array& array) {
    const std::string group = hdf5_parent_of(array.path);
    std::vector<std::string> axes = file.texts(group, "axes");
    if (axes.empty()) {  // of files before 2014: names with colons between them, an attribute of the array
        std::string joined = file.text(array.path, "axes");
        std::ranges::replace(joined, ':', ' ');
        std::ranges::replace(joined, ',', ' ');
        for (const std::string_view word : split_words(joined)) axes.emplace_back(word);
    }
    if (axes.empty()) return {};
    std::vector<std::string> of_dimension(array.dims.size());
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const std::vector<double> indices = file.numbers(group, axes[i] + "_indices");
        const double d = are_numbers(indices, 1) ? indices[0] : static_cast<double>(i);
        if (axes[i] != "." && d >= 0 && d < static_cast<double>(array.dims.size())) of_dimension[static_cast<std::size_t>(d)] = axes[i];
    }
    return of_dimension;
}

PlacedAxis read_nexus_axis(const Hdf5File& file, const std::string& group, const std::string& name, std::vector<std::string>& notes) {
    const std::string path = join_path(group, name);
    PlacedAxis axis{.name = name};
    if (file.kind(path) != Hdf5File::Kind::array) return axis;
    const Hdf5Array array = file.array(path);
    if (array.dims.size() != 1 || !array.type.is_number) {
        notes.push_back("the coordinates " + in_quotes(name) + " are not a list of numbers: they were left out");
        return axis;
    }
    axis.unit = file.text(path, "units");
    axis.places = file.line(path);
    return axis;
}

void set_nexus_axes(const Hdf5File& file, const Hdf5Array& array, Hdf5Place& place, VolumeInfo& info) {
    const std::vector<std::string> names = nexus_axes(file, array);
    if (names.empty()) return;
    info.format = "NeXus";
    std::array<PlacedAxis, 3> axes;
    for (std::size_t a = 0; a < 3; ++a) {
        if (place.dimension[a] < 0) continue;
        const std::string& name = names[static_cast<std::size_t>(place.dimension[a])];
        if (!name.empty()) axes[a] = read_nexus_axis(file, hdf5_parent_of(array.path), name, info.notes);
    }
    set_placed_axes(info, std::move(axes), place.flipped);
}

/// What attributes of the array say about it.
void set_array_attributes(const Hdf5File& file, const Hdf5Array& array, VolumeInfo& info) {
    info.value_unit = file.text(array.path, "units");
    info.description = file.text(array.path, "long_name");
    const std::vector<double> factor = file.numbers(array.path, "scale_factor"), offset = file.numbers(array.path, "add_offset");
    if (are_numbers(factor, 1) || are_numbers(offset, 1))
        set_calibration(info, are_numbers(factor, 1) ? factor[0] : 1, are_numbers(offset, 1) ? offset[0] : 0);
    if (file.has_attribute(array.path, "gridSpacing") && array.dims.size() == static_cast<std::size_t>(info.extent.rank)) {
        set_openpmd_geometry(file, array.path, array.path, info);
        const bool has_unit = file.has_attribute(array.path, "gridUnit") || file.has_attribute(array.path, "gridUnitSI");
        if (!has_unit) info.geometry.unit.clear();
        if (const std::string space = file.text(array.path, "space"); !space.empty()) info.geometry.space = space;
        return;
    }
    const std::vector<double> micrometres = file.numbers(array.path, "element_size_um");  // of several programs of microscopy, z first
    if (!are_numbers(micrometres, 3) || info.extent.rank != 3) return;
    for (int a = 0; a < 3; ++a) set_axis_spacing(info, a, micrometres[static_cast<std::size_t>(2 - a)]);
    info.geometry.unit = "um";
}

/// The dimensions of an array that are x, y, z, and the time step where it has one more.
Hdf5Place place_array(const Hdf5Request& request, const Hdf5Array& array, VolumeInfo& info) {
    std::vector<std::size_t> kept;
    for (std::size_t d = 0; d < array.dims.size(); ++d) {
        if (array.dims.size() <= 3 || array.dims[d] > 1) kept.push_back(d);
    }
    const std::size_t rank = std::min<std::size_t>(kept.size(), 3);
    if (kept.size() < 2 || kept.size() > 4 || std::ranges::find(array.dims, 0) != array.dims.end()) {
        throw Error(ErrorKind::unsupported, {.file = request.path(),
                                             .where = shown_name(array.path),
                                             .what = "the dataset is " + (array.dims.empty() ? "one value" : shape_of(array)),
                                             .expected = "2 or 3 dimensions, or 4 with time slowest",
                                             .next = "choose another dataset, or reshape or slice it"});
    }
    Hdf5Place place = place_volume(array, static_cast<int>(rank), info);
    for (std::size_t a = 0; a < rank; ++a) {
        const std::size_t d = kept[kept.size() - 1 - a];
        place.dimension[a] = static_cast<int>(d);
        info.extent.size[a] = array.dims[d];
        if (!array.chunk.empty()) info.chunk[a] = std::clamp<std::int64_t>(array.chunk[d], 1, array.dims[d]);
    }
    info.volumes.time_steps = kept.size() == 4 ? array.dims[kept[0]] : 1;
    info.volumes.time_step = choose_time_step(request.path(), request.options, info.volumes.time_steps).index;
    place.index[kept[0]] = info.volumes.time_step;  // 0 where there is no time
    return place;
}

std::unique_ptr<VolumeReader> open_chosen(const Hdf5Request& request, const std::string& path, std::vector<std::string> notes) {
    const Hdf5File& file = *request.file;
    const Hdf5Array array = file.array(path);
    VolumeInfo info = request.info("HDF5");
    info.volumes.has_datasets = true;
    info.notes = std::move(notes);
    info.notes.insert(info.notes.begin(), "the dataset " + shown_name(path));
    if (!array.type.is_number) return make_hdf5_reader(std::move(info), request.file, array, {});  // refuses it
    Hdf5Place place = place_array(request, array, info);
    set_array_attributes(file, array, info);
    set_nexus_axes(file, array, place, info);
    return make_hdf5_reader(std::move(info), request.file, array, place);
}

}  // namespace

Hdf5Walk walk_hdf5(const Hdf5File& file, const std::string& root) {
    Hdf5Walk walk;
    std::set<std::string> seen{file.identity(root)};
    std::deque<std::string> groups{root};
    std::size_t refused = 0, broken = 0;
    std::string reason;
    while (!groups.empty() && seen.size() < kMostObjects) {
        const std::string group = groups.front();
        groups.pop_front();
        for (const std::string& name : file.names(group)) {
            const std::string path = join_path(group, name);
            std::optional<Error> error;
            const Hdf5File::Kind kind = path.size() > kLongestPath ? Hdf5File::Kind::other : file.kind(path, &error);
            if (error && error->text().reason == Reason::file_outside_folder) ++refused, reason = path;
            if (kind == Hdf5File::Kind::none) ++broken;
            if ((kind != Hdf5File::Kind::group && kind != Hdf5File::Kind::array) || !seen.insert(file.identity(path)).second) continue;
            if (kind == Hdf5File::Kind::group)
                groups.push_back(path);
            else if (Hdf5Array array = file.array(path); array.type.is_number)
                walk.arrays.push_back(std::move(array));
        }
    }
    if (refused > 0) {
        walk.notes.push_back(std::to_string(refused) + (refused == 1 ? " link leads" : " links lead") +
                             " out of the folder of the file and was not followed: " + shown_name(reason));
    }
    if (broken > refused) walk.notes.push_back(std::to_string(broken - refused) + " links of the file lead nowhere");
    return walk;
}

std::unique_ptr<VolumeReader> open_hdf5_array(const Hdf5Request& request) {
    const Hdf5File& file = *request.file;
    std::string root = "/";
    OpenOptions options = request.options;
    if (options.dataset) {
        std::string wanted = options.dataset->starts_with('/') ? *options.dataset : "/" + *options.dataset;
        while (wanted.size() > 1 && wanted.ends_with('/')) wanted.pop_back();
        std::optional<Error> error;
        const Hdf5File::Kind kind = file.kind(wanted, &error);
        if (error) throw Error(*error);
        if (kind == Hdf5File::Kind::array) return open_chosen(request, wanted, {});
        if (kind == Hdf5File::Kind::group) root = wanted, options.dataset.reset();
        if (const std::string signal = signal_of(file, root); kind == Hdf5File::Kind::group && !signal.empty())
            return open_chosen(request, signal, {});
    } else if (const std::string own = own_array(file); !own.empty()) {
        return open_chosen(request, own, {});
    } else if (const std::string group = default_data(file); !group.empty()) {
        const std::string signal = signal_of(file, group);
        if (!signal.empty() && is_candidate(file.array(signal), 4)) return open_chosen(request, signal, {});
    }
    Hdf5Walk walk = walk_hdf5(file, root);
    const std::vector<ErrorChoice> choices = choices_of(walk.arrays);
    if (choices.empty()) no_arrays(request.path(), walk.arrays);
    const std::string chosen = choices[choose_dataset(request.path(), options, choices)].word;
    return open_chosen(request, chosen, std::move(walk.notes));
}

}  // namespace isoatlas
