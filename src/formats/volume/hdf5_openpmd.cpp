// openPMD: /data/ITERATION/meshes/NAME, or NAME/COMPONENT; iterations are time steps.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/choose.h"
#include "formats/volume/hdf5_conventions.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

/// Their names, by their numbers: some have leading zeros.
std::vector<std::string> openpmd_iterations(const Hdf5File& file) {
    std::vector<std::pair<std::int64_t, std::string>> numbered;
    for (const std::string& name : file.names("/data")) {
        if (const std::optional<std::int64_t> number = number_behind(name, "")) numbered.emplace_back(*number, name);
    }
    std::ranges::sort(numbered);
    std::vector<std::string> iterations;
    for (auto& [number, name] : numbered) iterations.push_back(std::move(name));
    return iterations;
}

/// The group of the meshes of an iteration.
std::string openpmd_meshes(const Hdf5File& file, const std::string& iteration) {
    std::string folder = file.text("/", "meshesPath");
    if (folder.empty()) folder = "meshes";
    while (folder.ends_with('/')) folder.pop_back();
    while (folder.starts_with('/')) folder.erase(0, 1);
    return "/data/" + iteration + "/" + folder;
}

/// Arrays of 2 or 3 dimensions, by their paths beneath the meshes: "/rho", "/E/x".
std::vector<ErrorChoice> openpmd_choices(const Hdf5File& file, const std::string& meshes) {
    constexpr std::size_t kMostMeshes = 10'000;
    std::vector<ErrorChoice> choices;
    const auto add = [&](const std::string& path) {
        const Hdf5Array array = file.array(path);
        if (array.type.is_number && (array.dims.size() == 2 || array.dims.size() == 3))
            choices.push_back({path.substr(meshes.size()), shape_of(array)});
    };
    for (const std::string& mesh : file.names(meshes)) {
        const std::string path = join_path(meshes, mesh);
        const Hdf5File::Kind kind = file.kind(path);
        if (kind == Hdf5File::Kind::array) add(path);
        if (kind != Hdf5File::Kind::group) continue;
        for (const std::string& component : file.names(path)) {
            if (choices.size() < kMostMeshes && file.kind(join_path(path, component)) == Hdf5File::Kind::array)
                add(join_path(path, component));
        }
    }
    return choices;
}

/// What isoatlas writes for directions that openPMD has not. Numbers that are none are left out.
void set_own_directions(const Hdf5File& file, const std::string& mesh, VolumeInfo& info) {
    const std::vector<double> origin = file.numbers(mesh, "gridOrigin"), direction = file.numbers(mesh, "gridDirection");
    if (!are_numbers(origin, 3) || !are_numbers(direction, 9)) return;
    for (std::size_t a = 0; a < 3; ++a) {
        constexpr double kRounding = 1e-6;
        if (!(std::abs(std::hypot(direction[a], direction[3 + a], direction[6 + a]) - 1) < kRounding)) return;
    }
    for (std::size_t i = 0; i < 9; ++i) info.geometry.direction[i / 3][i % 3] = direction[i];
    for (std::size_t a = 0; a < 3; ++a) info.geometry.origin[a] = origin[a];
}

/// options.dataset as a path beneath the meshes, if it is the whole path of an array.
OpenOptions beneath_meshes(const OpenOptions& options, const std::string& meshes) {
    OpenOptions own = options;
    if (own.dataset && !own.dataset->starts_with('/')) own.dataset->insert(0, "/");
    if (own.dataset && own.dataset->starts_with(meshes + "/")) own.dataset->erase(0, meshes.size());
    return own;
}

}  // namespace

// Places the axes by their labels: the first label is that of the slowest dimension, with dataOrder F of the fastest.
void set_openpmd_geometry(const Hdf5File& file, const std::string& mesh, const std::string& component, VolumeInfo& info) {
    const auto rank = static_cast<std::size_t>(info.extent.rank);
    const std::vector<std::string> labels = file.texts(mesh, "axisLabels");
    const std::vector<double> spacing = file.numbers(mesh, "gridSpacing"), offset = file.numbers(mesh, "gridGlobalOffset"),
                              inside = file.numbers(component, "position"), units = file.numbers(mesh, "gridUnitSI");
    const std::string name = file.text(mesh, "gridUnit");
    const double unit = name.empty() && are_numbers(units, 1) && units[0] > 0 ? units[0] : 1;
    if (!are_numbers(spacing, rank)) {
        info.notes.emplace_back("the spacing of the mesh is not given: 1 was assumed");
        return;
    }
    const std::string geometry = file.text(mesh, "geometry");
    if (!geometry.empty() && geometry != "cartesian")
        info.notes.push_back("the coordinates of the mesh are " + geometry + ": they are taken as cartesian");
    std::array<int, 3> row{0, 1, 2};  // of space, for each axis of the volume
    const bool is_fortran = file.text(mesh, "dataOrder") == "F";
    std::string seen;
    bool is_labelled = labels.size() == rank;
    for (std::size_t a = 0; a < rank && is_labelled; ++a) {
        const std::string& label = labels[is_fortran ? a : rank - 1 - a];
        const std::size_t found = std::string("xyz").find(label);
        is_labelled = label.size() == 1 && found != std::string::npos && seen.find(label) == std::string::npos;
        if (is_labelled) row[a] = static_cast<int>(found), seen += label;
    }
    if (!is_labelled) row = {0, 1, 2};
    info.geometry.origin = {0, 0, 0};
    for (std::size_t a = 0; a < rank; ++a) {
        const std::size_t i = is_fortran ? a : rank - 1 - a;
        Vec3 step{};
        step[static_cast<std::size_t>(row[a])] = spacing[i] * unit;
        set_axis_step(info, static_cast<int>(a), step);
        const double begin = (are_numbers(offset, rank) ? offset[i] : 0) + (are_numbers(inside, rank) ? inside[i] * spacing[i] : 0);
        if (std::isfinite(begin * unit)) info.geometry.origin[static_cast<std::size_t>(row[a])] = begin * unit;
    }
    if (rank == 2) complete_normal(info.geometry);
    set_own_directions(file, mesh, info);
    require_frame(info);
    info.geometry.unit = name.empty() ? "m" : name;
}

std::unique_ptr<VolumeReader> open_openpmd(const Hdf5Request& request) {
    const Hdf5File& file = *request.file;
    if (!file.has_attribute("/", "openPMD")) return nullptr;
    const std::vector<std::string> iterations = openpmd_iterations(file);
    if (iterations.empty()) return nullptr;
    OpenOptions options = request.options;
    for (std::size_t i = 0; i < iterations.size() && options.dataset && !options.time_step; ++i) {
        const std::string all = openpmd_meshes(file, iterations[i]);
        if (beneath_meshes(options, all).dataset != beneath_meshes(options, "").dataset) options.time_step = static_cast<std::int64_t>(i);
    }
    VolumeInfo info = request.info("openPMD");
    FileVolumes& volumes = info.volumes;
    volumes.has_datasets = true;
    volumes.time_steps = static_cast<std::int64_t>(iterations.size());
    volumes.time_step = choose_time_step(request.path(), options, volumes.time_steps).index;
    const std::string& iteration = iterations[static_cast<std::size_t>(volumes.time_step)];
    const std::string meshes = openpmd_meshes(file, iteration);
    options = beneath_meshes(options, meshes);
    const std::vector<ErrorChoice> choices = openpmd_choices(file, meshes);
    if (choices.empty() || (options.dataset && file.kind(meshes + *options.dataset) == Hdf5File::Kind::none && file.has(*options.dataset)))
        return nullptr;
    const std::string word = choices[choose_dataset(request.path(), options, choices)].word;
    const std::string component = meshes + word, mesh = meshes + word.substr(0, word.find('/', 1));
    for (const std::string& other : iterations) {
        const std::string group = "/data/" + other;
        const std::vector<double> time = file.numbers(group, "time"), unit = file.numbers(group, "timeUnitSI");
        if (!are_numbers(time, 1)) break;
        volumes.times.push_back(time[0] * (are_numbers(unit, 1) ? unit[0] : 1));
    }
    if (volumes.times.size() != iterations.size()) volumes.times.clear();
    if (!volumes.times.empty()) volumes.time_unit = "s";
    const Hdf5Array array = file.array(component);
    const Hdf5Place place = place_volume(array, static_cast<int>(array.dims.size()), info);
    set_openpmd_geometry(file, mesh, component, info);
    const std::vector<double> factor = file.numbers(component, "unitSI");
    if (are_numbers(factor, 1) && factor[0] != 1) {
        set_calibration(info, factor[0], 0);
        info.notes.emplace_back("values are converted to SI units (unitSI)");
    }
    info.notes.push_back("the mesh " + in_quotes(word.substr(1)) + " of iteration " + iteration);
    return make_hdf5_reader(std::move(info), request.file, array, place);
}

}  // namespace isoatlas
