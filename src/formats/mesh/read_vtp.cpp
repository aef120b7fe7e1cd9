// VTP: polygons and strips of all pieces become triangles; vertices and lines are skipped.
#include <pugixml.hpp>

#include "formats/common/byte_cursor.h"
#include "formats/common/vtk_arrays.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

[[noreturn]] void fail(const std::string& file, std::string what, std::string where = {}) {
    throw Error(ErrorKind::input, {.file = file, .where = std::move(where), .what = std::move(what), .next = kDamagedFile});
}

/// Raw appended data is not XML: the part before it is completed and parsed, the bytes after '_' are decoded separately.
std::string split_appended(std::string_view bytes, VtkEncoding& encoding) {
    const std::size_t tag = bytes.find("<AppendedData");
    if (tag == std::string_view::npos) return std::string(bytes);
    const std::size_t end = bytes.find('>', tag);
    const std::size_t mark = bytes.find('_', end);
    if (end == std::string_view::npos || mark == std::string_view::npos) fail(encoding.file, "the appended data is cut off");
    encoding.appended = bytes.substr(mark + 1);
    return std::string(bytes.substr(0, end + 1)) + "</AppendedData></VTKFile>";
}

void read_encoding(const pugi::xml_node& root, VtkEncoding& encoding) {
    if (std::string_view(root.name()) != "VTKFile" || std::string_view(root.attribute("type").value()) != "PolyData") {
        fail(encoding.file, "not a VTK file of PolyData");
    }
    encoding.big_endian = std::string_view(root.attribute("byte_order").value()) == "BigEndian";
    encoding.header_bytes = std::string_view(root.attribute("header_type").value()) == "UInt64" ? 8 : 4;
    encoding.appended_base64 = std::string_view(root.child("AppendedData").attribute("encoding").as_string("base64")) != "raw";
    const std::string compressor = root.attribute("compressor").value();
    encoding.zlib = compressor == "vtkZLibDataCompressor";
    if (!compressor.empty() && !encoding.zlib) {
        throw Error(ErrorKind::unsupported, {.file = encoding.file,
                                             .what = "compressed with " + in_quotes(compressor),
                                             .expected = "vtkZLibDataCompressor or none",
                                             .next = "write the file again with zlib or without compression"});
    }
}

pugi::xml_node array_named(const pugi::xml_node& parent, const char* name) {
    return parent.find_child_by_attribute("DataArray", "Name", name);
}

std::vector<std::int64_t> integers(const pugi::xml_node& element, VtkEncoding& encoding) {
    VtkValues values = read_vtk_array(element, encoding);
    if (values.is_real) fail(encoding.file, "cells are numbered with floating-point numbers");
    return std::move(values.integers);
}

/// Returns the number of points.
std::size_t read_points(const pugi::xml_node& piece, VtkEncoding& encoding, Mesh& mesh) {
    const pugi::xml_node element = piece.child("Points").child("DataArray");
    if (!element) {
        if (piece.attribute("NumberOfPoints").as_llong() != 0) fail(encoding.file, "a piece without its points");
        return 0;
    }
    const VtkValues values = read_vtk_array(element, encoding);
    const std::size_t count = values.size() / 3;
    std::uint64_t promised = 0;
    if (!parse_number(std::string_view(piece.attribute("NumberOfPoints").as_string()), promised) || promised != count ||
        values.size() % 3 != 0) {
        fail(encoding.file, "a piece promises " + in_quotes(piece.attribute("NumberOfPoints").as_string()) + " points and holds " +
                                std::to_string(values.size()) + " coordinates");
    }
    const auto coordinate = [&](std::size_t i) { return values.is_real ? values.reals[i] : static_cast<double>(values.integers[i]); };
    for (std::size_t i = 0; i < count; ++i) mesh.points.push_back({coordinate(3 * i), coordinate(3 * i + 1), coordinate(3 * i + 2)});
    return count;
}

/// Adds the cells of <Polys> or <Strips>; their indices count from first_point.
void read_cells(const pugi::xml_node& cells, VtkEncoding& encoding, std::size_t first_point, std::size_t points, bool strips, Mesh& mesh) {
    const pugi::xml_node connectivity_element = array_named(cells, "connectivity"), offsets_element = array_named(cells, "offsets");
    if (!connectivity_element || !offsets_element) return;
    const std::vector<std::int64_t> connectivity = integers(connectivity_element, encoding);
    const std::vector<std::int64_t> offsets = integers(offsets_element, encoding);
    std::vector<std::int64_t> corners;
    std::int64_t begin = 0;
    for (const std::int64_t end : offsets) {
        if (end < begin || end > static_cast<std::int64_t>(connectivity.size()))
            fail(encoding.file, "the cell offsets do not ascend within the connectivity");
        corners.clear();
        for (std::int64_t i = begin; i < end; ++i) {
            const std::int64_t point = connectivity[static_cast<std::size_t>(i)];
            if (point < 0 || point >= static_cast<std::int64_t>(points)) {
                fail(encoding.file, "a cell names point " + std::to_string(point) + ", which its piece does not have");
            }
            corners.push_back(point + static_cast<std::int64_t>(first_point));
        }
        if (strips) {
            add_strip(mesh, corners);
        } else {
            add_polygon(mesh, corners);
        }
        begin = end;
    }
}

/// Ids of a piece; false when it has none (or an array of another program with this name, of another type or length).
bool read_ids(const pugi::xml_node& piece, const char* name, std::size_t points, VtkEncoding& encoding, Array<std::int64_t>& ids) {
    const pugi::xml_node element = array_named(piece.child("PointData"), name);
    if (!element) return points == 0;
    const VtkValues values = read_vtk_array(element, encoding);
    if (values.is_real || values.size() != points) return false;
    ids.insert(ids.end(), values.integers.begin(), values.integers.end());
    return true;
}

}  // namespace

Mesh parse_vtp(std::string_view bytes, const std::string& file) {
    VtkEncoding encoding;
    encoding.file = file;
    const std::string xml = split_appended(bytes, encoding);
    pugi::xml_document document;
    if (const pugi::xml_parse_result result = document.load_buffer(xml.data(), xml.size()); !result) {
        fail(file, std::string("not well-formed XML: ") + result.description(), "offset " + std::to_string(result.offset));
    }
    const pugi::xml_node root = document.document_element();
    read_encoding(root, encoding);
    encoding.budget = static_cast<std::int64_t>(bytes.size() * (encoding.zlib ? 1032 : 1));  // deflate cannot do better
    Mesh mesh;
    bool has_object = true, has_contour = true;
    for (const pugi::xml_node& piece : root.child("PolyData").children("Piece")) {
        const std::size_t first = mesh.points.size();
        const std::size_t points = read_points(piece, encoding, mesh);
        read_cells(piece.child("Polys"), encoding, first, points, false, mesh);
        read_cells(piece.child("Strips"), encoding, first, points, true, mesh);
        has_object = read_ids(piece, "ObjectId", points, encoding, mesh.object) && has_object;
        has_contour = read_ids(piece, "ContourId", points, encoding, mesh.contour) && has_contour;
    }
    if (!has_object) mesh.object.clear();
    if (!has_contour) mesh.contour.clear();
    check_mesh(mesh, file);
    return mesh;
}

}  // namespace isoatlas
