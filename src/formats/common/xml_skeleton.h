// The tags of a VTK XML file without the data between them, for an XML parser.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace isoatlas {

class File;

/// Names of attributes that the skeleton adds to each DataArray with content: the range of its text in the file.
inline constexpr const char* kContentBegin = "content-begin";
inline constexpr const char* kContentEnd = "content-end";

struct XmlSkeleton {
    std::string text;            ///< well formed when the file is; without text, comments and instructions
    std::int64_t appended = -1;  ///< offset of the first byte after the '_' of AppendedData; -1: no such section
};

/// Scans a file up to its AppendedData section, or to its end. Cost: one pass with a fixed buffer; memory: the tags, at most 16 MiB.
/// path: for messages. Throws Error{input}: a tag is not closed, tags beyond that limit, an AppendedData section without '_'.
[[nodiscard]] XmlSkeleton read_xml_skeleton(std::unique_ptr<File> file, const std::string& path);

}  // namespace isoatlas
