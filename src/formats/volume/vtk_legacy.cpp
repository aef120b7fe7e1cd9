// Legacy VTK files (.vtk): STRUCTURED_POINTS and RECTILINEAR_GRID, text and binary; the first array with one number for each point, or
// for each cell where no array has one for each point.
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "formats/common/byte_source.h"
#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/formats.h"
#include "formats/volume/sample_reader.h"
#include "formats/volume/vtk_legacy_file.h"

namespace isoatlas {
namespace {

constexpr std::string_view kFirstLine = "# vtk DataFile Version";

Geometry rectilinear(const VtkLegacyFile& file, bool cells) {
    std::array<std::vector<double>, 3> coordinates;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const VtkLegacyArray& array = file.coordinates[axis];
        const std::int64_t count = file.points.size[axis];
        if (array.tuples != count) {
            bad_field(file.path, "coordinates of axis " + std::to_string(axis), std::to_string(array.tuples) + " coordinates",
                      std::to_string(count));
        }
        coordinates[axis] = read_doubles(file.path, file.open(array), *array.type, file.is_big_endian(), count);
    }
    return rectilinear_geometry(file.path, std::move(coordinates), cells);
}

void set_regular_geometry(const VtkLegacyFile& file, bool cells, VolumeInfo& info) {
    info.geometry.origin = file.origin;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 step{};
        step[axis] = file.spacing[axis];
        set_axis_step(info, axis, step);
        if (cells && file.points.size[axis] > 1 && std::isfinite(step[axis])) info.geometry.origin[axis] += step[axis] / 2;
    }
    for (double& place : info.geometry.origin) {
        if (std::isfinite(place)) continue;
        info.notes.emplace_back("the origin of the file is not finite: 0 is used");
        place = 0;
    }
}

[[noreturn]] void no_samples(const VtkLegacyFile& file) {
    const std::string names = first_of(file.others, in_quotes);
    throw Error(ErrorKind::unsupported,
                {.file = file.path,
                 .what = "has no array with one number for each point or cell" + (names.empty() ? "" : "; it has " + names),
                 .expected = "SCALARS of 8 to 64-bit integers, float or double",
                 .next = "save one component, e.g. in ParaView with the filter Calculator"});
}

}  // namespace

bool looks_like_vtk_legacy(FirstBytes first, const std::string&) {
    return std::string_view(reinterpret_cast<const char*>(first.data()), first.size()).starts_with(kFirstLine);
}

std::unique_ptr<VolumeReader> open_vtk_legacy(const std::string& path, const OpenOptions& options) {
    const VtkLegacyFile file = read_vtk_legacy(path);
    if (!file.samples) no_samples(file);
    const VtkLegacyArray& samples = *file.samples;
    (void)choose_time_step(path, options, 1);
    VolumeInfo info;
    info.path = path;
    info.format = "VTK legacy";
    info.encoding = file.binary ? "raw" : "ascii";
    info.file_bytes = file_size(path);
    info.type = *samples.type;
    info.big_endian = file.is_big_endian();
    info.description = file.title;
    info.extent = file.points.samples(samples.cells);
    (void)sample_bytes(path, info.extent, info.type);
    info.notes.push_back("the array " + in_quotes(samples.name) + (samples.cells ? ", of the cells" : ""));
    if (samples.slope != 1) set_calibration(info, samples.slope, 0);
    if (file.rectilinear)
        info.geometry = rectilinear(file, samples.cells);
    else
        set_regular_geometry(file, samples.cells, info);
    if (info.extent.rank == 2) info.notes.emplace_back("the grid has a single slice along z: read as a 2D image");
    std::unique_ptr<ByteSource> source = file.open(samples);
    return make_sample_reader(std::move(info), std::move(source), options, {}, samples.wide);
}

}  // namespace isoatlas
