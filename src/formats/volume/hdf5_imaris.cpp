// Imaris (.ims): /DataSet/ResolutionLevel N/TimePoint t/Channel c/Data. Arrays are filled up to whole chunks; attributes are lists of
// characters.
#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/choose.h"
#include "formats/volume/hdf5_conventions.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMostImarisLevels = 64;
constexpr const char* kImarisInfo = "/DataSetInfo/Image";

std::string imaris_level(std::int64_t level) { return "/DataSet/ResolutionLevel " + std::to_string(level); }
std::string imaris_array(std::int64_t level, std::int64_t step, std::int64_t channel) {
    return imaris_level(level) + "/TimePoint " + std::to_string(step) + "/Channel " + std::to_string(channel);
}

/// Members of a group that are "PREFIX 0", "PREFIX 1", ... up to the first that is missing.
std::int64_t imaris_count(const Hdf5File& file, const std::string& group, const std::string& prefix) {
    std::vector<std::int64_t> numbers;
    for (const std::string& name : file.names(group)) {
        if (const std::optional<std::int64_t> number = number_behind(name, prefix + " ")) numbers.push_back(*number);
    }
    std::ranges::sort(numbers);
    std::int64_t count = 0;
    for (const std::int64_t number : numbers) count += number == count ? 1 : 0;
    return count;
}

/// Sizes without what fills the array up.
Index3 imaris_size(const Hdf5File& file, std::int64_t level, std::int64_t step, std::int64_t channel) {
    const std::string group = imaris_array(level, step, channel);
    Index3 size = size_of_volume(file.array(group + "/Data"));
    for (std::size_t a = 0; a < 3; ++a) {
        const std::string axis(1, "XYZ"[a]);
        std::string text = file.text(group, "ImageSize" + axis);
        if (text.empty() && level == 0) text = file.text(kImarisInfo, axis);
        const std::optional<std::int64_t> real = parse_integer(text);
        if (real && *real >= 1 && *real <= size[a]) size[a] = *real;
    }
    return size;
}

/// "2012-01-31 12:00:00.000" in seconds since 1970.
std::optional<double> imaris_time(const std::string& text) {
    const std::vector<std::string_view> words = split_words(text);
    if (words.size() != 2 || words[0].size() != 10 || words[1].size() < 8) return std::nullopt;
    const auto year = parse_integer(words[0].substr(0, 4)), month = parse_integer(words[0].substr(5, 2)),
               day = parse_integer(words[0].substr(8, 2));
    const auto hour = parse_integer(words[1].substr(0, 2)), minute = parse_integer(words[1].substr(3, 2));
    const auto second = parse_number(words[1].substr(6));
    if (!year || !month || !day || !hour || !minute || !second || *month < 1 || *month > 12 || !std::isfinite(*second)) return std::nullopt;
    const std::int64_t y = *year - (*month <= 2 ? 1 : 0), from_march = (*month + 9) % 12;  // the Gregorian calendar, years from March on
    const std::int64_t days = 365 * y + y / 4 - y / 100 + y / 400 + (153 * from_march + 2) / 5 + *day - 1 - 719468;
    return static_cast<double>(86400 * days + 3600 * *hour + 60 * *minute) + *second;
}

void set_imaris_times(const Hdf5File& file, std::int64_t steps, FileVolumes& volumes) {
    std::vector<double> times;
    for (std::int64_t step = 0; step < steps; ++step) {
        const std::optional<double> time = imaris_time(file.text("/DataSetInfo/TimeInfo", "TimePoint" + std::to_string(step + 1)));
        if (!time) return;
        times.push_back(*time);
    }
    const double first = times.empty() ? 0 : times[0];
    for (double& time : times) time -= first;
    volumes.times = std::move(times);
    volumes.time_unit = "s";
}

/// ExtMin and ExtMax are the ends of the first and the last sample.
void set_imaris_geometry(const Hdf5File& file, VolumeInfo& info) {
    bool is_placed = true;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::string number = std::to_string(a);
        const std::optional<double> low = parse_number(file.text(kImarisInfo, "ExtMin" + number));
        const std::optional<double> high = parse_number(file.text(kImarisInfo, "ExtMax" + number));
        const double spacing = low && high ? (*high - *low) / static_cast<double>(info.extent.size[a]) : 0;
        if (!(std::isfinite(spacing) && spacing > 0)) {
            is_placed = false;
            continue;
        }
        info.geometry.spacing[a] = spacing;
        info.geometry.origin[a] = *low + spacing / 2;
    }
    if (!is_placed) info.notes.emplace_back("the extent of the image is not given along every axis: a spacing of 1 was assumed there");
    const std::string unit = file.text(kImarisInfo, "Unit");
    info.geometry.unit = unit.empty() ? "um" : unit;
}

}  // namespace

std::unique_ptr<VolumeReader> open_imaris(const Hdf5Request& request) {
    const Hdf5File& file = *request.file;
    if (request.options.dataset || file.kind(imaris_level(0) + "/TimePoint 0/Channel 0/Data") != Hdf5File::Kind::array) return nullptr;
    VolumeInfo info = request.info("Imaris");
    FileVolumes& volumes = info.volumes;
    const std::int64_t levels = std::min(imaris_count(file, "/DataSet", "ResolutionLevel"), kMostImarisLevels);
    volumes.level = choose_level(request.path(), request.options, levels);
    volumes.time_steps = imaris_count(file, imaris_level(0), "TimePoint");
    volumes.time_step = choose_time_step(request.path(), request.options, volumes.time_steps).index;
    const std::int64_t channels = imaris_count(file, imaris_level(0) + "/TimePoint 0", "Channel");
    for (std::int64_t c = 0; c < channels; ++c) volumes.channels.push_back(file.text("/DataSetInfo/Channel " + std::to_string(c), "Name"));
    volumes.channel = choose_channel(request.path(), request.options, volumes.channels);
    set_imaris_times(file, volumes.time_steps, volumes);
    const Hdf5Array array = file.array(imaris_array(volumes.level, volumes.time_step, volumes.channel) + "/Data");
    if (array.dims.size() != 3) bad_field(request.path(), array.path, std::to_string(array.dims.size()) + " dimensions", "3");
    for (std::int64_t level = 0; level < levels; ++level)
        volumes.levels.push_back(imaris_size(file, level, volumes.time_step, volumes.channel));
    if (levels == 1) volumes.levels.clear();
    const Hdf5Place place = place_volume(array, 3, info);
    info.extent.size = imaris_size(file, volumes.level, volumes.time_step, volumes.channel);
    info.chunk = min(info.chunk, info.extent.size);
    set_imaris_geometry(file, info);
    if (info.extent.size[2] == 1) info.extent.rank = 2;
    const std::string name = file.text(kImarisInfo, "Name"), description = file.text(kImarisInfo, "Description");
    info.description = name + (name.empty() || description.empty() ? "" : "\n") + description;
    if (info.description.starts_with("(") && info.description.ends_with(")")) info.description.clear();  // "(name not specified)"
    return make_hdf5_reader(std::move(info), request.file, array, place);
}

}  // namespace isoatlas
