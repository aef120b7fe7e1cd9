// NRRD, attached header. Format: http://teem.sourceforge.net/nrrd/format.html
#include <bit>

#include "formats/common/byte_writer.h"
#include "formats/common/generator.h"
#include "formats/common/gzip_stream.h"
#include "formats/common/volume_file.h"
#include "isoatlas/units.h"

namespace isoatlas {

namespace {

std::string type_name(ValueType type) {
    if (type == ValueType::f32) return "float";
    return type == ValueType::f64 ? "double" : name_of(type);
}

/// 2D images without a space are planar; everything else is in 3D space.
int space_dimension(const VolumeInfo& info, const Geometry& geometry) {
    const Mat3& m = geometry.direction;
    const bool flat = m[2][0] == 0 && m[2][1] == 0 && geometry.origin[2] == 0;
    return info.extent.rank == 2 && flat && geometry.space == "unknown" ? 2 : 3;
}

std::string space_line(const Geometry& geometry, int dimension) {
    if (geometry.space == "LPS") return "space: left-posterior-superior\n";
    if (geometry.space == "RAS") return "space: right-anterior-superior\n";
    if (geometry.space == "LAS") return "space: left-anterior-superior\n";
    return "space dimension: " + std::to_string(dimension) + "\n";
}

std::string vector_text(const Vec3& vector, int dimension) {
    std::string text = "(";
    for (int i = 0; i < dimension; ++i) text += (i > 0 ? "," : "") + number_text(vector[i]);
    return text + ")";
}

std::string geometry_lines(const VolumeInfo& info) {
    const Geometry geometry = regular_geometry(info);
    const int dimension = space_dimension(info, geometry);
    std::string text = space_line(geometry, dimension) + "space directions:";
    for (int axis = 0; axis < info.extent.rank; ++axis) {
        Vec3 step{};
        for (int row = 0; row < 3; ++row) step[row] = geometry.direction[row][axis] * geometry.spacing[axis];
        text += " " + vector_text(step, dimension);
    }
    text += "\nspace origin: " + vector_text(geometry.origin, dimension) + "\n";
    const std::string unit = ascii_unit(one_line(geometry.unit));
    if (unit.empty() || unit.find('"') != std::string::npos) return text;
    text += "space units:";
    for (int i = 0; i < dimension; ++i) text += " \"" + unit + "\"";
    return text + "\n";
}

std::string header_text(const VolumeInfo& info, Packing packing, const KeyValues& pairs) {
    std::string text = std::string("NRRD0005\n# written by ") + kGenerator + "\n";
    if (is_rectilinear(info.geometry)) text += "# the grid was rectilinear: its coordinates are replaced by their mean spacing\n";
    if (!info.description.empty()) text += "content: " + one_line(info.description) + "\n";
    text += "type: " + type_name(info.type) + "\ndimension: " + std::to_string(info.extent.rank) + "\nsizes:";
    for (int axis = 0; axis < info.extent.rank; ++axis) text += " " + std::to_string(info.extent.size[axis]);
    text += "\n" + geometry_lines(info);
    if (size_of(info.type) > 1) text += std::endian::native == std::endian::big ? "endian: big\n" : "endian: little\n";
    if (!info.value_unit.empty()) text += "sample units: " + one_line(info.value_unit) + "\n";
    text += packing == Packing::gzip ? "encoding: gzip\n" : "encoding: raw\n";
    if (!info.calibration.is_identity()) {
        text += "calibration_slope:=" + number_text(info.calibration.slope) + "\n";
        text += "calibration_intercept:=" + number_text(info.calibration.intercept) + "\n";
    }
    for (const auto& [key, value] : pairs) text += key + ":=" + value + "\n";
    return text + "\n";
}

}  // namespace

void write_nrrd(Sink& sink, const VolumeInfo& info, const SampleFeed& samples, Packing packing, const KeyValues& pairs) {
    sink.write(header_text(info, packing, pairs));
    if (packing == Packing::gzip) {
        GzipStream stream(sink);
        samples([&](std::span<const std::byte> bytes) { stream.write(bytes); });
        stream.finish();
    } else {
        samples([&](std::span<const std::byte> bytes) { sink.write(bytes); });
    }
}

}  // namespace isoatlas
