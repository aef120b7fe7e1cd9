// BigDataViewer (.h5 beside .xml): /tNNNNN/sNN/L/cells, setups as channels. Samples are stored as int16 and mean uint16.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <pugixml.hpp>

#include "formats/common/byte_source.h"
#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/choose.h"
#include "formats/volume/hdf5_conventions.h"

namespace isoatlas {
namespace {

std::vector<std::int64_t> viewer_numbers(const Hdf5File& file, const std::string& group, const std::string& prefix) {
    std::vector<std::int64_t> numbers;
    for (const std::string& name : file.names(group)) {
        if (const std::optional<std::int64_t> number = number_behind(name, prefix)) numbers.push_back(*number);
    }
    std::ranges::sort(numbers);
    return numbers;
}

std::string numbered(const char* prefix, std::int64_t number, std::size_t digits) {
    const std::string text = std::to_string(number);
    return prefix + std::string(digits > text.size() ? digits - text.size() : 0, '0') + text;
}

struct ViewerSetup {
    std::string name{}, unit{};
    Vec3 voxel{1, 1, 1};
    bool has_voxel = false;
};

/// The setups of the .xml beside the file, by their numbers; none where it is not there or cannot be understood.
std::map<std::int64_t, ViewerSetup> viewer_setups(const std::string& path, VolumeInfo& info) {
    constexpr std::int64_t kMostBytes = std::int64_t{16} << 20;
    std::map<std::int64_t, ViewerSetup> setups;
    const std::string sibling = std::filesystem::path(path).replace_extension(".xml").string();
    std::vector<std::byte> bytes;
    try {
        bytes = read_header_bytes(sibling, kMostBytes);
    } catch (const Error&) {
        info.notes.emplace_back("the .xml of BigDataViewer is not beside the file: a spacing of 1 was assumed");
        return setups;
    }
    pugi::xml_document document;
    document.load_buffer(bytes.data(), bytes.size());
    for (const pugi::xml_node node : document.child("SpimData").child("SequenceDescription").child("ViewSetups").children("ViewSetup")) {
        ViewerSetup setup{.name = node.child("name").text().get(), .unit = node.child("voxelSize").child("unit").text().get()};
        const std::vector<std::string_view> words = split_words(node.child("voxelSize").child("size").text().get());
        setup.has_voxel = words.size() == 3;
        for (std::size_t a = 0; a < 3 && setup.has_voxel; ++a) {
            const std::optional<double> size = parse_number(words[a]);
            setup.has_voxel = size && std::isfinite(*size) && *size > 0;
            if (setup.has_voxel) setup.voxel[a] = *size;
        }
        if (const std::optional<std::int64_t> id = parse_integer(trim(node.child("id").text().get()))) setups[*id] = setup;
    }
    return setups;
}

}  // namespace

std::unique_ptr<VolumeReader> open_big_data_viewer(const Hdf5Request& request) {
    const Hdf5File& file = *request.file;
    if (request.options.dataset || request.file->kind("/t00000") != Hdf5File::Kind::group) return nullptr;
    const std::vector<std::int64_t> steps = viewer_numbers(file, "/", "t"), setups = viewer_numbers(file, "/", "s");
    if (setups.empty() || file.kind("/" + numbered("s", setups[0], 2) + "/resolutions") != Hdf5File::Kind::array) return nullptr;
    VolumeInfo info = request.info("BigDataViewer");
    FileVolumes& volumes = info.volumes;
    std::map<std::int64_t, ViewerSetup> told = viewer_setups(request.path(), info);
    if (!told.empty()) info.notes.emplace_back("the transforms of the .xml (ViewRegistrations) are not applied");
    for (const std::int64_t setup : setups) volumes.channels.push_back(told[setup].name);
    volumes.channel = choose_channel(request.path(), request.options, volumes.channels);
    volumes.time_steps = static_cast<std::int64_t>(steps.size());
    volumes.time_step = choose_time_step(request.path(), request.options, volumes.time_steps).index;
    const std::int64_t setup = setups[static_cast<std::size_t>(volumes.channel)];
    const std::string name = numbered("s", setup, 2),
                      group = "/" + numbered("t", steps[static_cast<std::size_t>(volumes.time_step)], 5) + "/" + name;
    const std::vector<double> factors = file.line("/" + name + "/resolutions");
    const auto cells = [&](std::size_t level) { return group + "/" + std::to_string(level) + "/cells"; };
    std::size_t levels = 0;
    while (3 * levels + 2 < factors.size() && file.kind(cells(levels)) == Hdf5File::Kind::array) ++levels;
    if (levels == 0) bad_field(request.path(), cells(0), "the array of this time step and setup is missing", "an array of 3 dimensions");
    volumes.level = choose_level(request.path(), request.options, static_cast<std::int64_t>(levels));
    for (std::size_t level = 0; level < levels && levels > 1; ++level) volumes.levels.push_back(size_of_volume(file.array(cells(level))));
    const Hdf5Array array = file.array(cells(static_cast<std::size_t>(volumes.level)));
    if (array.dims.size() != 3) bad_field(request.path(), array.path, std::to_string(array.dims.size()) + " dimensions", "3");
    const Hdf5Place place = place_volume(array, 3, info);
    if (array.type.value == ValueType::i16) {
        info.type = ValueType::u16;
        info.notes.emplace_back("samples are stored as int16 and read as uint16, as BigDataViewer does");
    }
    for (std::size_t a = 0; a < 3; ++a) {
        const double factor = factors[3 * static_cast<std::size_t>(volumes.level) + a];
        set_axis_spacing(info, static_cast<int>(a), told[setup].voxel[a] * factor);
        if (std::isfinite(factor) && factor > 0)
            info.geometry.origin[a] = told[setup].voxel[a] * (factor - 1) / 2;  // samples of a level are means
    }
    if (told[setup].has_voxel) info.geometry.unit = told[setup].unit;
    if (info.extent.size[2] == 1) info.extent.rank = 2;
    return make_hdf5_reader(std::move(info), request.file, array, place);
}

}  // namespace isoatlas
