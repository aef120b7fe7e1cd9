// VTI: image data of VTK, one appended block of raw samples. Source: VTK file formats, docs.vtk.org.
#include "formats/common/byte_writer.h"
#include "formats/common/volume_file.h"
#include "formats/common/vtk_writer.h"

namespace isoatlas {

namespace {

const char* vtk_name(ValueType type) {
    static constexpr const char* kNames[] = {"UInt8", "Int8", "UInt16", "Int16", "UInt32", "Int32", "Float32", "Float64"};
    return kNames[static_cast<int>(type)];
}

std::string numbers(const Vec3& values) { return number_text(values[0]) + " " + number_text(values[1]) + " " + number_text(values[2]); }

std::string header(const VolumeInfo& info) {
    const Geometry geometry = regular_geometry(info);
    std::string extent;
    for (int axis = 0; axis < 3; ++axis) extent += (axis > 0 ? " 0 " : "0 ") + std::to_string(info.extent.size[axis] - 1);
    std::string text = vtk_file_begin("ImageData") + "<ImageData WholeExtent=\"" + extent + "\" Origin=\"" + numbers(geometry.origin) +
                       "\" Spacing=\"" + numbers(geometry.spacing) + "\" Direction=\"" + numbers(geometry.direction[0]) + " " +
                       numbers(geometry.direction[1]) + " " + numbers(geometry.direction[2]) + "\">\n";
    text += "<FieldData>\n" + vtk_string("Space", geometry.space);
    if (!geometry.unit.empty()) text += vtk_string("Unit", geometry.unit);
    return text + "</FieldData>\n<Piece Extent=\"" + extent + "\">\n<PointData Scalars=\"values\">\n<DataArray type=\"" +
           vtk_name(info.type) + "\" Name=\"values\" format=\"appended\" offset=\"0\"/>\n</PointData>\n<CellData>\n</CellData>\n" +
           "</Piece>\n</ImageData>\n";
}

}  // namespace

void write_vti(Sink& sink, const VolumeInfo& info, const SampleFeed& samples) {
    ByteWriter out(sink);
    out.text(header(info));
    begin_appended_data(out);
    out.put(static_cast<std::uint64_t>(info.extent.voxels()) * size_of(info.type));
    out.finish();
    samples([&](std::span<const std::byte> bytes) { sink.write(bytes); });
    sink.write("\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace isoatlas
