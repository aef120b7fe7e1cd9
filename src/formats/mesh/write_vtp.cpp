// VTP: VTK polygonal data. Keeps everything: 64-bit ids, float64 where needed, tau, space, unit and interpolant as field data.
#include <functional>

#include "formats/common/connectivity.h"
#include "formats/common/precision.h"
#include "formats/common/vtk_writer.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

std::string points_element(AppendedArrays& arrays, const MeshParts& parts) {
    const auto put_all = [&parts](ByteWriter& out, const auto& convert) {
        for (const MeshPart& part : parts.parts) {
            for (std::size_t i = 0; i < part.surface().points.size(); ++i) out.put(convert(part.turned.point(i)));
        }
    };
    if (position_precision(parts) == Real::f64) {
        return arrays.add<double>("Points", 3, parts.points, [put_all](ByteWriter& out) { put_all(out, std::identity{}); });
    }
    return arrays.add<float>("Points", 3, parts.points, [put_all](ByteWriter& out) { put_all(out, to_float); });
}

std::string id_element(AppendedArrays& arrays, const char* name, const MeshParts& parts, Array<std::int64_t> Surface::* ids) {
    return arrays.add<std::int64_t>(name, 1, parts.points, [&parts, ids](ByteWriter& out) {
        for (const MeshPart& part : parts.parts) {
            for (const std::int64_t id : part.surface().*ids) out.put(id);
        }
    });
}

/// Of named parts: their numbers from 1, and their colours.
std::string part_elements(AppendedArrays& arrays, const MeshParts& parts) {
    const auto put_each = [&parts](const auto& put) {
        for (std::size_t n = 0; n < parts.parts.size(); ++n) {
            for (std::size_t i = 0; i < parts.parts[n].surface().points.size(); ++i) put(n);
        }
    };
    std::string text = arrays.add<std::int64_t>("Object", 1, parts.points, [put_each](ByteWriter& out) {
        put_each([&](std::size_t n) { out.put(static_cast<std::int64_t>(n + 1)); });
    });
    text += arrays.add<std::uint8_t>("Colour", 3, parts.points, [put_each, &parts](ByteWriter& out) {
        put_each([&](std::size_t n) { out.put(parts.parts[n].colour); });
    });
    return text;
}

std::string point_data(AppendedArrays& arrays, const MeshParts& parts) {
    std::string text = "<PointData";
    if (parts.named) {
        text += " Scalars=\"Object\"";
    } else if (parts.has_object) {
        text += " Scalars=\"ObjectId\"";
    }
    if (parts.has_normals) text += " Normals=\"Normals\"";
    text += ">\n";
    if (parts.named) text += part_elements(arrays, parts);
    if (parts.has_object) text += id_element(arrays, "ObjectId", parts, &Surface::object);
    if (parts.has_contour) text += id_element(arrays, "ContourId", parts, &Surface::contour);
    if (parts.has_normals) {
        text += arrays.add<float>("Normals", 3, parts.points, [&parts](ByteWriter& out) {
            for (const MeshPart& part : parts.parts) {
                for (std::size_t i = 0; i < part.surface().normals.size(); ++i) out.put(part.turned.normal(i));
            }
        });
    }
    return text + "</PointData>\n";
}

/// get: cell i of a part.
template <std::size_t N, class Get>
std::string cells(AppendedArrays& arrays, const char* tag, const MeshParts& parts, std::int64_t count, const Get& get) {
    std::string text = std::string("<") + tag + ">\n";
    text += arrays.add<std::int64_t>("connectivity", 1, static_cast<std::int64_t>(N) * count, [&parts, get, count](ByteWriter& out) {
        if (count == 0) return;
        for (const MeshPart& part : parts.parts) {
            const std::size_t of_part = N == 3 ? part.surface().triangles.size() : part.surface().segments.size();
            for (std::size_t i = 0; i < of_part; ++i) {
                for (const std::int64_t p : get(part, i)) out.put(p + part.first_point);
            }
        }
    });
    text += arrays.add<std::int64_t>("offsets", 1, count, [count](ByteWriter& out) {
        for (std::int64_t i = 1; i <= count; ++i) out.put(static_cast<std::int64_t>(N) * i);
    });
    return text + "</" + tag + ">\n";
}

/// One value for each named part. "SPACE" is what 3D Slicer looks for.
std::string field_data(AppendedArrays& arrays, const MeshParts& parts) {
    const auto count = static_cast<std::int64_t>(parts.parts.size());
    std::string text = "<FieldData>\n" + arrays.add<double>(
                                             "Tau", 1, count,
                                             [&parts](ByteWriter& out) {
                                                 for (const MeshPart& part : parts.parts) out.put(part.surface().reported_tau);
                                             },
                                             true);
    text += vtk_string("Space", parts.space);
    if (parts.says_space()) text += vtk_string("SPACE", parts.space);
    if (!parts.unit.empty()) text += vtk_string("Unit", parts.unit);
    if (parts.named) {
        std::vector<std::string> names;
        for (const MeshPart& part : parts.parts) names.push_back(part.name);
        text += vtk_strings("ObjectName", names);
    }
    return text + vtk_elements(arrays, connectivity_of(parts)) + "</FieldData>\n";
}

}  // namespace

void write_vtp(Sink& sink, const MeshParts& parts, Warnings&) {
    AppendedArrays arrays;
    ByteWriter out(sink);
    out.text(vtk_file_begin("PolyData") + "<PolyData>\n" + field_data(arrays, parts));
    out.text("<Piece NumberOfPoints=\"" + std::to_string(parts.points) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
             std::to_string(parts.segments) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(parts.triangles) + "\">\n");
    out.text(point_data(arrays, parts));
    out.text("<Points>\n" + points_element(arrays, parts) + "</Points>\n");
    out.text(cells<2>(arrays, "Lines", parts, parts.segments, [](const MeshPart& part, std::size_t i) { return part.turned.segment(i); }));
    out.text(
        cells<3>(arrays, "Polys", parts, parts.triangles, [](const MeshPart& part, std::size_t i) { return part.turned.triangle(i); }));
    out.text("</Piece>\n</PolyData>\n");
    arrays.write(out);
    out.text("</VTKFile>\n");
    out.finish();
}

}  // namespace isoatlas
