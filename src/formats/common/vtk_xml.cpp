#include "formats/common/vtk_xml.h"

#include <utility>

#include "formats/common/text.h"
#include "formats/common/xml_skeleton.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

/// Attributes with a default that affect the samples: one that differs in a single character is damaged, and a default would be wrong.
void check_root(const std::string& path, const pugi::xml_node& root) {
    for (const pugi::xml_attribute given : root.attributes()) {
        for (const char* known : {"byte_order", "header_type", "compressor"}) {
            if (is_damaged(given.name(), known)) refuse_vtk(path, "VTKFile", "has an attribute " + in_quotes(given.name()), known);
        }
    }
    const std::string_view order = vtk_attribute(root, "byte_order");
    if (!order.empty() && order != "LittleEndian" && order != "BigEndian")
        refuse_vtk(path, "VTKFile byte_order", in_quotes(order), "LittleEndian or BigEndian");
}

}  // namespace

void refuse_vtk(const std::string& path, const std::string& where, const std::string& what, const std::string& expected) {
    throw Error(ErrorKind::input, {.file = path,
                                   .where = where,
                                   .what = what,
                                   .expected = expected,
                                   .next = "the file is damaged: write it again, e.g. with ParaView"});
}

std::string_view vtk_attribute(const pugi::xml_node& node, const char* name) { return trim(node.attribute(name).value()); }

VtkXml read_vtk_xml(std::unique_ptr<File> file, const std::string& path) {
    const XmlSkeleton skeleton = read_xml_skeleton(std::move(file), path);
    VtkXml xml{{}, skeleton.appended};
    const pugi::xml_parse_result result = xml.document.load_buffer(skeleton.text.data(), skeleton.text.size(),
                                                                   pugi::parse_minimal | pugi::parse_escapes, pugi::encoding_utf8);
    if (!result) refuse_vtk(path, "XML header", std::string("is not well-formed XML: ") + result.description(), "a VTK XML file");
    return xml;
}

VtkFile describe_vtk_file(const VtkXml& xml, const std::string& path, std::function<std::unique_ptr<File>()> open) {
    const pugi::xml_node root = xml.root();
    check_root(path, root);
    VtkFile file;
    file.path = path;
    file.open = std::move(open);
    file.big_endian = vtk_attribute(root, "byte_order") == "BigEndian";
    const std::string_view header = vtk_attribute(root, "header_type");
    if (!header.empty() && header != "UInt32" && header != "UInt64") {
        refuse_vtk(path, "VTKFile header_type", in_quotes(header), "UInt32 or UInt64");
    }
    file.wide_headers = header == "UInt64";
    const std::string_view compressor = vtk_attribute(root, "compressor");
    if (compressor == "vtkZLibDataCompressor") {
        file.compressor = VtkCompressor::zlib;
    } else if (compressor == "vtkLZ4DataCompressor") {
        file.compressor = VtkCompressor::lz4;
    } else if (!compressor.empty()) {
        throw Error(ErrorKind::unsupported, {.file = path,
                                             .where = "VTKFile compressor",
                                             .what = in_quotes(compressor),
                                             .expected = "vtkZLibDataCompressor, vtkLZ4DataCompressor or none",
                                             .next = "write it with zlib or LZ4, in ParaView: Save Data > Compressor Type"});
    }
    file.appended = xml.appended;
    const std::string_view encoding = vtk_attribute(root.child("AppendedData"), "encoding");
    file.appended_is_raw = encoding == "raw";
    if (!encoding.empty() && encoding != "raw" && encoding != "base64")
        refuse_vtk(path, "AppendedData encoding", in_quotes(encoding), "raw or base64");
    return file;
}

VtkArray describe_vtk_array(const pugi::xml_node& node, const std::string& path) {
    VtkArray array;
    array.name = vtk_attribute(node, "Name");
    const std::string where = "array " + in_quotes(array.name);
    array.type = vtk_attribute(node, "type");
    const std::string_view format = vtk_attribute(node, "format");
    if (format == "appended") {
        array.format = VtkFormat::appended;
        const std::optional<std::int64_t> offset = parse_integer(vtk_attribute(node, "offset"));
        if (!offset) refuse_vtk(path, where, "has no offset", "a number of bytes");
        array.offset = *offset;
        return array;
    }
    if (!format.empty() && format != "ascii" && format != "binary")
        refuse_vtk(path, where, "format " + in_quotes(format), "ascii, binary or appended");
    array.format = format == "binary" ? VtkFormat::binary : VtkFormat::ascii;
    array.begin = parse_integer(vtk_attribute(node, kContentBegin)).value_or(0);
    array.end = parse_integer(vtk_attribute(node, kContentEnd)).value_or(0);
    return array;
}

}  // namespace isoatlas
