// VTK XML: ImageData (.vti) and RectilinearGrid (.vtr), one piece, one scalar array.
#include <algorithm>
#include <optional>
#include <pugixml.hpp>
#include <string_view>

#include "formats/common/file_access.h"
#include "formats/common/text.h"
#include "formats/common/vtk_xml.h"
#include "formats/volume/formats.h"
#include "formats/volume/named_type.h"
#include "formats/volume/sample_reader.h"
#include "formats/volume/vtk_geometry.h"

namespace isoatlas {

namespace {

[[noreturn]] void unsupported(const std::string& path, const std::string& where, const std::string& what, const std::string& expected,
                              const std::string& next) {
    throw Error(ErrorKind::unsupported, {.file = path, .where = where, .what = what, .expected = expected, .next = next});
}

NamedType sample_type(const std::string& path, const VtkArray& array, bool may_be_wide) {
    static constexpr NamedType kTypes[] = {{"UInt8", ValueType::u8},
                                           {"Int8", ValueType::i8},
                                           {"UInt16", ValueType::u16},
                                           {"Int16", ValueType::i16},
                                           {"UInt32", ValueType::u32},
                                           {"Int32", ValueType::i32},
                                           {"Float32", ValueType::f32},
                                           {"Float64", ValueType::f64},
                                           {"Int64", ValueType::f64, WideInteger::int64},
                                           {"UInt64", ValueType::f64, WideInteger::uint64}};
    const NamedType* found = find_named_type(kTypes, array.type);
    if (found != nullptr && (may_be_wide || found->wide == WideInteger::none)) return *found;
    unsupported(path, "array " + in_quotes(array.name), "samples are of type " + in_quotes(array.type),
                may_be_wide ? "Int8 to UInt64, Float32 or Float64" : "Int8 to UInt32, Float32 or Float64",
                "convert the array, e.g. in ParaView with the filter Calculator (result type Float or Double)");
}

std::int64_t components(const pugi::xml_node& node) {
    const std::string_view text = vtk_attribute(node, "NumberOfComponents");
    return text.empty() ? 1 : parse_integer(text).value_or(0);
}

bool is_element(const pugi::xml_node& node, const char* name) { return std::string_view(node.name()) == name; }

/// The array to read: the active scalars, else the first with one component.
pugi::xml_node choose_array(const std::string& path, const pugi::xml_node& data, std::vector<std::string>& notes) {
    const std::string_view active = vtk_attribute(data, "Scalars");
    pugi::xml_node first, chosen;
    std::int64_t usable = 0;
    bool is_there = active.empty();
    for (const pugi::xml_node node : data.children()) {
        is_there = is_there || vtk_attribute(node, "Name") == active;
        if (!is_element(node, "DataArray") || components(node) != 1) continue;
        ++usable;
        if (!first) first = node;
        if (!active.empty() && vtk_attribute(node, "Name") == active && !chosen) chosen = node;
    }
    if (usable > 1) {
        if (!is_there) refuse_vtk(path, data.name(), "the active scalars are " + in_quotes(active), "the name of an array of the file");
        const pugi::xml_node taken = chosen ? chosen : first;
        notes.push_back("the file has " + std::to_string(usable) + " scalar arrays: " + in_quotes(vtk_attribute(taken, "Name")) +
                        " is read" + (chosen ? " (its active scalars)" : " (the first)"));
    }
    return chosen ? chosen : first;
}

bool has_arrays(const pugi::xml_node& data) { return static_cast<bool>(data.child("DataArray")); }

struct Choice {
    pugi::xml_node array;
    bool cells = false;
};

Choice choose_data(const std::string& path, const pugi::xml_node& piece, std::vector<std::string>& notes) {
    for (const bool cells : {false, true}) {
        const pugi::xml_node data = piece.child(cells ? "CellData" : "PointData");
        const pugi::xml_node array = choose_array(path, data, notes);
        if (!array) continue;
        if (cells) notes.push_back("the file has values of cells, not of points: each cell is read as one sample at its centre");
        return {.array = array, .cells = cells};
    }
    if (has_arrays(piece.child("PointData")) || has_arrays(piece.child("CellData"))) {
        unsupported(path, "PointData", "all arrays are vectors", "an array with one component",
                    "save the magnitude or one component as an array, e.g. in ParaView with the filter Calculator");
    }
    refuse_vtk(path, "PointData", "the file has no data array", "a DataArray with samples");
}

pugi::xml_node only_piece(const std::string& path, const pugi::xml_node& grid) {
    const pugi::xml_node piece = grid.child("Piece");
    if (!piece) refuse_vtk(path, grid.name(), "has no Piece", "one Piece");
    if (piece.next_sibling("Piece")) {
        unsupported(path, grid.name(), "the grid is cut into several pieces", "one piece",
                    "write it as one piece, e.g. open it in ParaView and save it again");
    }
    return piece;
}

pugi::xml_node find_grid(const std::string& path, const pugi::xml_node& root) {
    if (!is_element(root, "VTKFile")) refuse_vtk(path, "XML header", "the outermost element is " + in_quotes(root.name()), "VTKFile");
    const std::string_view type = vtk_attribute(root, "type");
    if (type != "ImageData" && type != "RectilinearGrid") {
        unsupported(path, "VTKFile type", "is " + in_quotes(type), "ImageData or RectilinearGrid",
                    type.starts_with('P') && type != "PolyData" ? "open the .vti or .vtr file that it lists"
                                                                : "resample it, e.g. in ParaView with the filter Resample To Image");
    }
    const pugi::xml_node grid = root.child(std::string(type).c_str());
    if (!grid) refuse_vtk(path, "VTKFile", "has no element " + in_quotes(type), "the grid");
    return grid;
}

}  // namespace

bool looks_like_vti(FirstBytes first, const std::string& path) {
    const std::string_view text(reinterpret_cast<const char*>(first.data()), first.size());
    const bool is_xml = text.find("<VTKFile") != std::string_view::npos;
    return is_xml || ends_with_ignoring_case(path, ".vti") || ends_with_ignoring_case(path, ".vtr");
}

std::unique_ptr<VolumeReader> open_vti(const std::string& path, const OpenOptions& options) {
    const auto open = [path] { return open_file(path); };
    const VtkXml xml = read_vtk_xml(open(), path);
    const pugi::xml_node grid = find_grid(path, xml.root()), piece = only_piece(path, grid);
    VtkFile file = describe_vtk_file(xml, path, open);
    file.skip_rest = options.skip_rest;
    (void)choose_time_step(path, options, 1);
    VolumeInfo info;
    info.path = path;
    info.format = is_element(grid, "ImageData") ? "VTI" : "VTR";
    info.file_bytes = file_size(path);
    const Choice choice = choose_data(path, piece, info.notes);
    const VtkArray array = describe_vtk_array(choice.array, path);
    const NamedType type = sample_type(path, array, /*may_be_wide=*/true);
    info.type = type.type;
    info.big_endian = array.format == VtkFormat::ascii ? needs_swap(false) : file.big_endian;
    info.encoding = vtk_encoding(file, array);
    info.description = array.name;
    const VtkExtent points = read_vtk_extent(path, grid, piece, info.notes);
    info.extent = points.samples(choice.cells);
    (void)sample_bytes(path, info.extent, info.type);
    if (is_element(grid, "ImageData")) {
        set_image_geometry(grid, points, choice.cells, info);
    } else {
        const auto open_coordinates = [&](const pugi::xml_node& node, std::int64_t count) {
            const VtkArray line = describe_vtk_array(node, path);
            return read_doubles(file, line, sample_type(path, line, /*may_be_wide=*/false).type, count);
        };
        info.geometry = rectilinear_geometry(path, piece, points, choice.cells, open_coordinates);
    }
    if (info.extent.rank == 2) info.notes.push_back("the grid has a single slice along z: read as a 2D image");
    auto source = open_vtk_array(file, array, info.type, info.extent.voxels(), type.wide);
    return make_sample_reader(std::move(info), std::move(source), options, {}, type.wide);
}

}  // namespace isoatlas
