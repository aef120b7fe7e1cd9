// VTKHDF images: /VTKHDF with the attribute Type "ImageData", arrays of points or cells, and steps in time.
#include <algorithm>
#include <cmath>

#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/choose.h"
#include "formats/volume/hdf5_conventions.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr const char* kVtkRoot = "/VTKHDF";

struct VtkImage {
    Index3 low{}, points{};
    std::int64_t steps = 1;
    bool has_steps = false;
};

VtkImage read_vtk_image(const Hdf5File& file) {
    VtkImage image;
    const std::vector<double> extent = file.numbers(kVtkRoot, "WholeExtent");
    constexpr double kLargestIndex = 0x1p40;
    bool is_sound = are_numbers(extent, 6);
    for (std::size_t a = 0; a < 3 && is_sound; ++a) {
        is_sound =
            extent[2 * a] <= extent[2 * a + 1] && std::abs(extent[2 * a]) < kLargestIndex && std::abs(extent[2 * a + 1]) < kLargestIndex;
        if (!is_sound) break;
        image.low[a] = static_cast<std::int64_t>(extent[2 * a]);
        image.points[a] = static_cast<std::int64_t>(extent[2 * a + 1]) - image.low[a] + 1;
    }
    if (!is_sound) bad_field(file.path(), "WholeExtent", "is not an extent", "six integers: first and last index of x, y, z");
    const std::vector<double> steps = file.numbers("/VTKHDF/Steps", "NSteps");
    image.has_steps = are_numbers(steps, 1) && steps[0] >= 1 && steps[0] < kLargestIndex;
    if (image.has_steps) image.steps = static_cast<std::int64_t>(steps[0]);
    return image;
}

Index3 samples_of(const VtkImage& image, bool cells) {
    Index3 size = image.points;
    for (std::size_t a = 0; a < 3 && cells; ++a) size[a] = std::max<std::int64_t>(size[a] - 1, 1);
    return size;
}

/// Whether the last dimensions of an array are those of the image; one more in front is time.
bool fits_image(const Hdf5Array& array, const VtkImage& image, bool cells) {
    const Index3 size = samples_of(image, cells);
    const std::size_t dims = array.dims.size(), space = size[2] == 1 && dims == (image.has_steps ? 3 : 2) ? 2 : 3;
    if (!array.type.is_number || (dims != space && !(image.has_steps && dims == space + 1))) return false;
    for (std::size_t a = 0; a < space; ++a) {
        if (array.dims[dims - 1 - a] != size[a]) return false;
    }
    return true;
}

struct VtkChoices {
    std::vector<ErrorChoice> choices{};
    std::vector<std::string> others{};  ///< arrays with several numbers for each sample
};

VtkChoices vtk_choices(const Hdf5File& file, const VtkImage& image) {
    VtkChoices found;
    for (const bool cells : {false, true}) {
        const std::string group = std::string(kVtkRoot) + (cells ? "/CellData" : "/PointData");
        for (const std::string& name : file.names(group)) {
            const std::string path = join_path(group, name);
            if (file.kind(path) != Hdf5File::Kind::array) continue;
            const Hdf5Array array = file.array(path);
            if (fits_image(array, image, cells))
                found.choices.push_back({path, shape_of(array) + (cells ? ", of the cells" : "")});
            else
                found.others.push_back(name);
        }
        if (!found.choices.empty()) break;  // arrays of cells only where there are none of points, as in other files of VTK
    }
    return found;
}

void set_vtk_geometry(const Hdf5File& file, const VtkImage& image, bool cells, VolumeInfo& info) {
    const auto given = [&](const char* name, const std::vector<double>& missing) {
        const std::vector<double> numbers = file.numbers(kVtkRoot, name);
        return are_numbers(numbers, missing.size()) ? numbers : missing;
    };
    const std::vector<double> origin = given("Origin", {0, 0, 0}), spacing = given("Spacing", {1, 1, 1}),
                              direction = given("Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1});
    for (std::size_t a = 0; a < 3; ++a) info.geometry.origin[a] = origin[a];
    for (std::size_t a = 0; a < 3; ++a) {
        Vec3 step{};
        for (std::size_t row = 0; row < 3; ++row) step[row] = direction[3 * row + a] * spacing[a];
        set_axis_step(info, static_cast<int>(a), step);
        const double first = static_cast<double>(image.low[a]) + (cells && image.points[a] > 1 ? 0.5 : 0.0);
        for (std::size_t row = 0; row < 3 && first != 0; ++row) info.geometry.origin[row] += step[row] * first;
    }
    require_frame(info);
    for (const double place : info.geometry.origin) {
        if (!std::isfinite(place)) bad_field(file.path(), "Origin", "the first sample is not at a finite position", "smaller numbers");
    }
}

/// Where the chosen step lies along the first dimension of an array.
std::int64_t vtk_step_offset(const Hdf5File& file, const Hdf5Array& array, const VtkImage& image, std::int64_t step) {
    std::string list = array.path;
    const std::size_t data = list.find("Data/");
    list.insert(data + 4, "Offsets");
    list.insert(std::string(kVtkRoot).size(), "/Steps");  // /VTKHDF/Steps/PointDataOffsets/NAME
    std::int64_t offset = step;
    if (file.kind(list) == Hdf5File::Kind::array) {
        const std::vector<double> offsets = file.line(list);
        if (static_cast<std::int64_t>(offsets.size()) == image.steps && std::abs(offsets[static_cast<std::size_t>(step)]) < 0x1p52)
            offset = static_cast<std::int64_t>(offsets[static_cast<std::size_t>(step)]);
    }
    if (offset < 0 || offset >= array.dims[0]) {
        bad_field(
            file.path(), array.path,
            "has " + std::to_string(array.dims[0]) + " steps, and step " + std::to_string(step) + " is number " + std::to_string(offset),
            "steps inside the array");
    }
    return offset;
}

[[noreturn]] void refuse_vtk_type(const Hdf5File& file, const std::string& type) {
    throw Error(ErrorKind::unsupported,
                {.file = file.path(),
                 .where = "/VTKHDF",
                 .what = type.empty() ? "is a VTKHDF file without a type" : "is a VTKHDF file of the type " + in_quotes(type),
                 .expected = "ImageData",
                 .next = "resample it to an image, e.g. in ParaView with the filter Resample To Image, and save that"});
}

}  // namespace

std::unique_ptr<VolumeReader> open_vtkhdf_image(const Hdf5Request& request) {
    const Hdf5File& file = *request.file;
    const std::optional<std::string>& wanted = request.options.dataset;
    if (file.kind(kVtkRoot) != Hdf5File::Kind::group || !file.has_attribute(kVtkRoot, "Version")) return nullptr;
    if (wanted && wanted->find("VTKHDF/") == std::string::npos) return nullptr;
    const std::string type = file.text(kVtkRoot, "Type");
    if (type != "ImageData") {
        if (wanted) return nullptr;
        refuse_vtk_type(file, type);
    }
    const VtkImage image = read_vtk_image(file);
    const VtkChoices found = vtk_choices(file, image);
    if (found.choices.empty()) {
        throw Error(ErrorKind::unsupported, {.file = request.path(),
                                             .where = "/VTKHDF",
                                             .what = "has no array with one number for each point or cell" +
                                                     (found.others.empty() ? "" : "; it has " + first_of(found.others, in_quotes)),
                                             .expected = "8 to 32 bit integers, float32 or float64",
                                             .next = "save one component, e.g. in ParaView with the filter Calculator"});
    }
    const Hdf5Array array = file.array(found.choices[choose_dataset(request.path(), request.options, found.choices)].word);
    const bool cells = array.path.find("/CellData/") != std::string::npos;
    VolumeInfo info = request.info("VTKHDF");
    FileVolumes& volumes = info.volumes;
    volumes.has_datasets = true;
    volumes.time_steps = image.steps;
    volumes.time_step = choose_time_step(request.path(), request.options, image.steps).index;
    const Index3 size = samples_of(image, cells);
    const bool has_time = image.has_steps && array.dims.size() == (size[2] == 1 && array.dims.size() == 3 ? 3U : 4U);
    const int dims = static_cast<int>(array.dims.size()) - (has_time ? 1 : 0);
    Hdf5Place place = place_volume(array, dims, info);
    if (has_time) place.index[0] = vtk_step_offset(file, array, image, volumes.time_step);
    info.extent.rank = size[2] == 1 ? 2 : 3;
    if (image.has_steps && file.kind("/VTKHDF/Steps/Values") == Hdf5File::Kind::array) {
        const std::vector<double> times = file.line("/VTKHDF/Steps/Values");
        if (are_numbers(times, static_cast<std::size_t>(image.steps))) volumes.times = times;
    }
    set_vtk_geometry(file, image, cells, info);
    info.notes.push_back("the array " + in_quotes(array.path.substr(array.path.rfind('/') + 1)) + (cells ? ", of the cells" : ""));
    if (info.extent.rank == 2) info.notes.emplace_back("the grid has a single slice along z: read as a 2D image");
    return make_hdf5_reader(std::move(info), request.file, array, place);
}

}  // namespace isoatlas
