// VTP: VTK polygonal data. Keeps everything: 64-bit ids, float64 where needed, tau, space, unit and interpolant as field data.
#include "formats/common/connectivity.h"
#include "formats/common/precision.h"
#include "formats/common/vtk_writer.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

std::string points_element(AppendedArrays& arrays, const Surface& surface) {
    const auto count = static_cast<std::int64_t>(surface.points.size());
    if (position_precision(surface) == Real::f64) {
        return arrays.add<double>("Points", 3, count, [&](ByteWriter& out) {
            for (const auto& point : surface.points) out.put(point);
        });
    }
    return arrays.add<float>("Points", 3, count, [&](ByteWriter& out) {
        for (const auto& point : surface.points) out.put(to_float(point));
    });
}

std::string id_element(AppendedArrays& arrays, const char* name, std::span<const std::int64_t> ids) {
    return arrays.add<std::int64_t>(name, 1, static_cast<std::int64_t>(ids.size()), [ids](ByteWriter& out) {
        for (const std::int64_t id : ids) out.put(id);
    });
}

std::string point_data(AppendedArrays& arrays, const Surface& surface) {
    std::string text = "<PointData";
    if (!surface.object.empty()) text += " Scalars=\"ObjectId\"";
    if (!surface.normals.empty()) text += " Normals=\"Normals\"";
    text += ">\n";
    if (!surface.object.empty()) text += id_element(arrays, "ObjectId", surface.object);
    if (!surface.contour.empty()) text += id_element(arrays, "ContourId", surface.contour);
    if (!surface.normals.empty()) {
        text += arrays.add<float>("Normals", 3, static_cast<std::int64_t>(surface.normals.size()), [&](ByteWriter& out) {
            for (const auto& normal : surface.normals) out.put(normal);
        });
    }
    return text + "</PointData>\n";
}

template <std::size_t N>
std::string cells(AppendedArrays& arrays, const char* tag, const Array<std::array<std::int64_t, N>>& cells) {
    const auto count = static_cast<std::int64_t>(cells.size());
    std::string text = std::string("<") + tag + ">\n";
    text += arrays.add<std::int64_t>("connectivity", 1, static_cast<std::int64_t>(N) * count, [&cells](ByteWriter& out) {
        for (const auto& cell : cells) out.put(cell);
    });
    text += arrays.add<std::int64_t>("offsets", 1, count, [count](ByteWriter& out) {
        for (std::int64_t i = 1; i <= count; ++i) out.put(static_cast<std::int64_t>(N) * i);
    });
    return text + "</" + tag + ">\n";
}

std::string field_data(AppendedArrays& arrays, const Surface& surface) {
    const double tau = surface.reported_tau;
    std::string text = "<FieldData>\n" + arrays.add<double>("Tau", 1, 1, [tau](ByteWriter& out) { out.put(tau); }, true);
    text += vtk_string("Space", surface.space);
    if (!surface.unit.empty()) text += vtk_string("Unit", surface.unit);
    return text + vtk_elements(arrays, connectivity_of(surface)) + "</FieldData>\n";
}

}  // namespace

void write_vtp(Sink& sink, const Surface& surface, Warnings&) {
    static const Array<std::array<std::int64_t, 3>> kNoTriangles;
    const auto& triangles = surface.segments.empty() ? surface.triangles : kNoTriangles;
    AppendedArrays arrays;
    ByteWriter out(sink);
    out.text(vtk_file_begin("PolyData") + "<PolyData>\n" + field_data(arrays, surface));
    out.text("<Piece NumberOfPoints=\"" + std::to_string(surface.points.size()) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
             std::to_string(surface.segments.size()) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(triangles.size()) +
             "\">\n");
    out.text(point_data(arrays, surface));
    out.text("<Points>\n" + points_element(arrays, surface) + "</Points>\n");
    out.text(cells(arrays, "Lines", surface.segments));
    out.text(cells(arrays, "Polys", triangles));
    out.text("</Piece>\n</PolyData>\n");
    arrays.write(out);
    out.text("</VTKFile>\n");
    out.finish();
}

}  // namespace isoatlas
