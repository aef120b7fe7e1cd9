// The header of a VTK XML file: its elements, and what they say of the data arrays.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "formats/common/vtk_array.h"

namespace isoatlas {

struct VtkXml {
    pugi::xml_document document;  ///< without text
    std::int64_t appended = -1;   ///< offset of the appended section; -1: none
    [[nodiscard]] pugi::xml_node root() const { return document.document_element(); }
};

// Each throws Error: input; unsupported (compressor). path: for messages.
[[nodiscard]] VtkXml read_vtk_xml(std::unique_ptr<File> file, const std::string& path);
[[nodiscard]] VtkFile describe_vtk_file(const VtkXml& xml, const std::string& path, std::function<std::unique_ptr<File>()> open);
[[nodiscard]] VtkArray describe_vtk_array(const pugi::xml_node& node, const std::string& path);

/// Without blanks around it; empty: there is none.
[[nodiscard]] std::string_view vtk_attribute(const pugi::xml_node& node, const char* name);
/// Throws Error{input}.
[[noreturn]] void refuse_vtk(const std::string& path, const std::string& where, const std::string& what, const std::string& expected);

}  // namespace isoatlas
