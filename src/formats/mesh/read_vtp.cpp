// VTP: polygons and strips of all pieces become triangles; vertices and lines are skipped.
#include <pugixml.hpp>

#include "formats/common/byte_cursor.h"
#include "formats/common/file_access.h"
#include "formats/common/vtk_xml.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

[[noreturn]] void fail_vtp(const std::string& file, std::string what, std::string where = {}) {
    throw Error(ErrorKind::input, {.file = file, .where = std::move(where), .what = std::move(what), .next = kDamagedFile});
}

/// The arrays of a file.
struct VtkArrays {
    VtkFile file;
    std::int64_t budget;  ///< values that they may still have
    [[nodiscard]] VtkValues read(const pugi::xml_node& element) {
        return read_vtk_values(file, describe_vtk_array(element, file.path), budget);
    }
};

pugi::xml_node array_named(const pugi::xml_node& parent, const char* name) {
    return parent.find_child_by_attribute("DataArray", "Name", name);
}

std::vector<std::int64_t> integers(const pugi::xml_node& element, VtkArrays& arrays) {
    VtkValues values = arrays.read(element);
    if (values.is_real) fail_vtp(arrays.file.path, "cells are numbered with floating-point numbers");
    return std::move(values.integers);
}

/// Returns the number of points.
std::size_t read_points(const pugi::xml_node& piece, VtkArrays& arrays, Mesh& mesh) {
    const pugi::xml_node element = piece.child("Points").child("DataArray");
    if (!element) {
        if (piece.attribute("NumberOfPoints").as_llong() != 0) fail_vtp(arrays.file.path, "a piece without its points");
        return 0;
    }
    const VtkValues values = arrays.read(element);
    const std::size_t count = values.size() / 3;
    std::uint64_t promised = 0;
    if (!parse_number(std::string_view(piece.attribute("NumberOfPoints").as_string()), promised) || promised != count ||
        values.size() % 3 != 0) {
        fail_vtp(arrays.file.path, "a piece promises " + in_quotes(piece.attribute("NumberOfPoints").as_string()) + " points and holds " +
                                       std::to_string(values.size()) + " coordinates");
    }
    const auto coordinate = [&](std::size_t i) { return values.is_real ? values.reals[i] : static_cast<double>(values.integers[i]); };
    for (std::size_t i = 0; i < count; ++i) mesh.points.push_back({coordinate(3 * i), coordinate(3 * i + 1), coordinate(3 * i + 2)});
    return count;
}

/// Adds the cells of <Polys> or <Strips>; their indices count from first_point.
void read_cells(const pugi::xml_node& cells, VtkArrays& arrays, std::size_t first_point, std::size_t points, bool strips, Mesh& mesh) {
    const pugi::xml_node connectivity_element = array_named(cells, "connectivity"), offsets_element = array_named(cells, "offsets");
    if (!connectivity_element || !offsets_element) return;
    const std::vector<std::int64_t> connectivity = integers(connectivity_element, arrays);
    const std::vector<std::int64_t> offsets = integers(offsets_element, arrays);
    std::vector<std::int64_t> corners;
    std::int64_t begin = 0;
    for (const std::int64_t end : offsets) {
        if (end < begin || end > static_cast<std::int64_t>(connectivity.size()))
            fail_vtp(arrays.file.path, "the cell offsets do not ascend within the connectivity");
        corners.clear();
        for (std::int64_t i = begin; i < end; ++i) {
            const std::int64_t point = connectivity[static_cast<std::size_t>(i)];
            if (point < 0 || point >= static_cast<std::int64_t>(points)) {
                fail_vtp(arrays.file.path, "a cell names point " + std::to_string(point) + ", which its piece does not have");
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
bool read_ids(const pugi::xml_node& piece, const char* name, std::size_t points, VtkArrays& arrays, Array<std::int64_t>& ids) {
    const pugi::xml_node element = array_named(piece.child("PointData"), name);
    if (!element) return points == 0;
    const VtkValues values = arrays.read(element);
    if (values.is_real || values.size() != points) return false;
    ids.insert(ids.end(), values.integers.begin(), values.integers.end());
    return true;
}

/// The text of a String array of the field data; empty when there is none, or another array of this name.
std::string field_text(const pugi::xml_node& fields, const char* name, VtkArrays& arrays) {
    const pugi::xml_node element = array_named(fields, name);
    if (!element || vtk_attribute(element, "type") != "String") return {};
    VtkArray array = describe_vtk_array(element, arrays.file.path);
    array.type = "UInt8";  // its characters
    const VtkValues values = read_vtk_values(arrays.file, array, arrays.budget);
    std::string text;
    for (const std::int64_t c : values.integers) {
        if (c == 0) break;
        text += static_cast<char>(c);
    }
    return printable(text);
}

void read_space(const pugi::xml_node& fields, VtkArrays& arrays, Mesh& mesh) {
    for (const char* name : {"Space", "SPACE"}) {
        if (const std::string space = field_text(fields, name, arrays); !space.empty()) mesh.space = space;
    }
    mesh.unit = field_text(fields, "Unit", arrays);
}

}  // namespace

Mesh parse_vtp(std::string_view bytes, const std::string& file) {
    const auto open = [bytes] { return open_bytes(bytes); };
    const VtkXml xml = read_vtk_xml(open(), file);
    if (std::string_view(xml.root().name()) != "VTKFile" || vtk_attribute(xml.root(), "type") != "PolyData") {
        fail_vtp(file, "not a VTK file of PolyData");
    }
    VtkArrays arrays{describe_vtk_file(xml, file, open), 0};
    arrays.budget = static_cast<std::int64_t>(bytes.size()) * largest_vtk_ratio(arrays.file.compressor);
    Mesh mesh;
    read_space(xml.root().child("PolyData").child("FieldData"), arrays, mesh);
    bool has_object = true, has_contour = true;
    for (const pugi::xml_node& piece : xml.root().child("PolyData").children("Piece")) {
        const std::size_t first = mesh.points.size();
        const std::size_t points = read_points(piece, arrays, mesh);
        read_cells(piece.child("Polys"), arrays, first, points, false, mesh);
        read_cells(piece.child("Strips"), arrays, first, points, true, mesh);
        const char* const object = array_named(piece.child("PointData"), "Object") ? "Object" : "ObjectId";
        has_object = read_ids(piece, object, points, arrays, mesh.object) && has_object;
        has_contour = read_ids(piece, "ContourId", points, arrays, mesh.contour) && has_contour;
    }
    if (!has_object) mesh.object.clear();
    if (!has_contour) mesh.contour.clear();
    check_mesh(mesh, file);
    return mesh;
}

}  // namespace isoatlas
