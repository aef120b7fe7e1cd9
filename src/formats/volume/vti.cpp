// VTK XML: ImageData (.vti) and RectilinearGrid (.vtr), one piece, one scalar array.
#include <algorithm>
#include <optional>
#include <pugixml.hpp>
#include <string_view>

#include "formats/common/text.h"
#include "formats/common/xml_skeleton.h"
#include "formats/volume/formats.h"
#include "formats/volume/sample_reader.h"
#include "formats/volume/vtk_array.h"
#include "formats/volume/vtk_geometry.h"

namespace isoatlas {

namespace {

[[noreturn]] void unsupported(const std::string& path, const std::string& where, const std::string& what, const std::string& expected,
                              const std::string& next) {
    throw Error(ErrorKind::unsupported, {.file = path, .where = where, .what = what, .expected = expected, .next = next});
}

[[noreturn]] void bad_xml(const std::string& path, const std::string& where, const std::string& what, const std::string& expected) {
    throw Error(ErrorKind::input, {.file = path,
                                   .where = where,
                                   .what = what,
                                   .expected = expected,
                                   .next = "the file is damaged: write it again, e.g. with ParaView"});
}

std::string_view attribute(const pugi::xml_node& node, const char* name) { return trim(node.attribute(name).value()); }

pugi::xml_document parse(const std::string& path, const XmlSkeleton& skeleton) {
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_buffer(skeleton.text.data(), skeleton.text.size(), pugi::parse_minimal | pugi::parse_escapes, pugi::encoding_utf8);
    if (!result) bad_xml(path, "XML header", std::string("is not well-formed XML: ") + result.description(), "a VTK XML file");
    return document;
}

/// Attributes with a default that affect the samples: one that differs in a single character is damaged, and a default would be wrong.
void check_root(const std::string& path, const pugi::xml_node& root) {
    for (const pugi::xml_attribute given : root.attributes()) {
        for (const char* known : {"byte_order", "header_type", "compressor"}) {
            if (is_damaged(given.name(), known)) bad_xml(path, "VTKFile", "has an attribute " + in_quotes(given.name()), known);
        }
    }
    const std::string_view order = attribute(root, "byte_order");
    if (!order.empty() && order != "LittleEndian" && order != "BigEndian")
        bad_xml(path, "VTKFile byte_order", in_quotes(order), "LittleEndian or BigEndian");
}

VtkFile describe_file(const std::string& path, const pugi::xml_node& root, const XmlSkeleton& skeleton) {
    check_root(path, root);
    VtkFile file;
    file.path = path;
    file.big_endian = attribute(root, "byte_order") == "BigEndian";
    const std::string_view header = attribute(root, "header_type");
    if (!header.empty() && header != "UInt32" && header != "UInt64") {
        bad_xml(path, "VTKFile header_type", in_quotes(header), "UInt32 or UInt64");
    }
    file.wide_headers = header == "UInt64";
    const std::string_view compressor = attribute(root, "compressor");
    file.compressed = !compressor.empty();
    if (file.compressed && compressor != "vtkZLibDataCompressor") {
        unsupported(path, "VTKFile compressor", in_quotes(compressor), "vtkZLibDataCompressor or none",
                    "write it with zlib or without compression, in ParaView: Save Data > Compressor Type");
    }
    file.appended = skeleton.appended;
    const std::string_view encoding = attribute(root.child("AppendedData"), "encoding");
    file.appended_is_raw = encoding == "raw";
    if (!encoding.empty() && encoding != "raw" && encoding != "base64")
        bad_xml(path, "AppendedData encoding", in_quotes(encoding), "raw or base64");
    return file;
}

/// nullopt for unsupported sample types.
std::optional<ValueType> value_type(std::string_view name) {
    static constexpr std::string_view kNames[] = {"UInt8", "Int8", "UInt16", "Int16", "UInt32", "Int32", "Float32", "Float64"};
    const auto found = std::find(std::begin(kNames), std::end(kNames), name);
    if (found == std::end(kNames)) return std::nullopt;
    return static_cast<ValueType>(found - std::begin(kNames));
}

std::int64_t components(const pugi::xml_node& node) {
    const std::string_view text = attribute(node, "NumberOfComponents");
    return text.empty() ? 1 : parse_integer(text).value_or(0);
}

bool is_element(const pugi::xml_node& node, const char* name) { return std::string_view(node.name()) == name; }

VtkArray describe_array(const std::string& path, const pugi::xml_node& node) {
    VtkArray array;
    array.name = attribute(node, "Name");
    const std::string where = "array " + in_quotes(array.name);
    const std::string_view type = attribute(node, "type");
    const std::optional<ValueType> value = value_type(type);
    if (!value) {
        unsupported(path, where, "samples are of type " + in_quotes(type), "Int8 to UInt32, Float32 or Float64",
                    "convert the array, e.g. in ParaView with the filter Calculator (result type Float or Double)");
    }
    array.type = *value;
    const std::string_view format = attribute(node, "format");
    if (format == "appended") {
        array.format = VtkFormat::appended;
        const std::optional<std::int64_t> offset = parse_integer(attribute(node, "offset"));
        if (!offset) bad_xml(path, where, "has no offset", "a number of bytes");
        array.offset = *offset;
        return array;
    }
    if (!format.empty() && format != "ascii" && format != "binary")
        bad_xml(path, where, "format " + in_quotes(format), "ascii, binary or appended");
    array.format = format == "binary" ? VtkFormat::binary : VtkFormat::ascii;
    array.begin = parse_integer(attribute(node, kContentBegin)).value_or(0);
    array.end = parse_integer(attribute(node, kContentEnd)).value_or(0);
    return array;
}

/// The array to read: the active scalars, else the first with one component.
pugi::xml_node choose_array(const std::string& path, const pugi::xml_node& data, std::vector<std::string>& notes) {
    const std::string_view active = attribute(data, "Scalars");
    pugi::xml_node first, chosen;
    std::int64_t usable = 0;
    bool is_there = active.empty();
    for (const pugi::xml_node node : data.children()) {
        is_there = is_there || attribute(node, "Name") == active;
        if (!is_element(node, "DataArray") || components(node) != 1) continue;
        ++usable;
        if (!first) first = node;
        if (!active.empty() && attribute(node, "Name") == active && !chosen) chosen = node;
    }
    if (usable > 1) {
        if (!is_there) bad_xml(path, data.name(), "the active scalars are " + in_quotes(active), "the name of an array of the file");
        const pugi::xml_node taken = chosen ? chosen : first;
        notes.push_back("the file has " + std::to_string(usable) + " scalar arrays: " + in_quotes(attribute(taken, "Name")) + " is read" +
                        (chosen ? " (its active scalars)" : " (the first)"));
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
    bad_xml(path, "PointData", "the file has no data array", "a DataArray with samples");
}

pugi::xml_node only_piece(const std::string& path, const pugi::xml_node& grid) {
    const pugi::xml_node piece = grid.child("Piece");
    if (!piece) bad_xml(path, grid.name(), "has no Piece", "one Piece");
    if (piece.next_sibling("Piece")) {
        unsupported(path, grid.name(), "the grid is cut into several pieces", "one piece",
                    "write it as one piece, e.g. open it in ParaView and save it again");
    }
    return piece;
}

pugi::xml_node find_grid(const std::string& path, const pugi::xml_node& root) {
    if (!is_element(root, "VTKFile")) bad_xml(path, "XML header", "the outermost element is " + in_quotes(root.name()), "VTKFile");
    const std::string_view type = attribute(root, "type");
    if (type != "ImageData" && type != "RectilinearGrid") {
        unsupported(path, "VTKFile type", "is " + in_quotes(type), "ImageData or RectilinearGrid",
                    type.starts_with('P') && type != "PolyData" ? "open the .vti or .vtr file that it lists"
                                                                : "resample it, e.g. in ParaView with the filter Resample To Image");
    }
    const pugi::xml_node grid = root.child(std::string(type).c_str());
    if (!grid) bad_xml(path, "VTKFile", "has no element " + in_quotes(type), "the grid");
    return grid;
}

}  // namespace

bool looks_like_vti(FirstBytes first, const std::string& path) {
    const std::string_view text(reinterpret_cast<const char*>(first.data()), first.size());
    const bool is_xml = text.find("<VTKFile") != std::string_view::npos;
    return is_xml || ends_with_ignoring_case(path, ".vti") || ends_with_ignoring_case(path, ".vtr");
}

std::unique_ptr<VolumeReader> open_vti(const std::string& path, const OpenOptions& options) {
    const XmlSkeleton skeleton = read_xml_skeleton(path);
    const pugi::xml_document document = parse(path, skeleton);
    const pugi::xml_node root = document.document_element(), grid = find_grid(path, root), piece = only_piece(path, grid);
    VtkFile file = describe_file(path, root, skeleton);
    file.skip_rest = options.skip_rest;
    (void)choose_time_step(path, options, 1);
    VolumeInfo info;
    info.path = path;
    info.format = is_element(grid, "ImageData") ? "VTI" : "VTR";
    info.file_bytes = file_size(path);
    const Choice choice = choose_data(path, piece, info.notes);
    const VtkArray array = describe_array(path, choice.array);
    info.type = array.type;
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
            return read_doubles(file, describe_array(path, node), count);
        };
        info.geometry = rectilinear_geometry(path, piece, points, choice.cells, open_coordinates);
    }
    if (info.extent.rank == 2) info.notes.push_back("the grid has a single slice along z: read as a 2D image");
    auto source = open_vtk_array(file, array, info.extent.voxels());
    return make_sample_reader(std::move(info), std::move(source), options);
}

}  // namespace isoatlas
