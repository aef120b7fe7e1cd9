// The DataArrays of VTK XML files, decoded: ascii, inline base64, appended raw or base64, each plain or in zlib blocks.
// Source: VTK file formats, docs.vtk.org.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pugi {
class xml_node;
}

namespace isoatlas {

/// Attributes of the VTKFile and AppendedData elements that apply to all arrays.
struct VtkEncoding {
    std::string file;  ///< for messages
    bool big_endian = false;
    std::size_t header_bytes = 4;  ///< of each number of a block header: 4 or 8
    bool zlib = false;
    bool appended_base64 = false;
    std::string_view appended;  ///< the bytes after '_'
    std::int64_t budget = 0;    ///< values that may still be decoded, bounded by the size of the file
};

/// The values of one array. Integers of 64 bits are kept exact.
struct VtkValues {
    std::vector<double> reals;           ///< of Float32 and Float64 arrays
    std::vector<std::int64_t> integers;  ///< of integer arrays
    bool is_real = false;
    [[nodiscard]] std::size_t size() const { return is_real ? reals.size() : integers.size(); }
};

/// Decodes a DataArray element. Throws Error: input (cut off, corrupt, contradictory), unsupported (type, compressor).
[[nodiscard]] VtkValues read_vtk_array(const pugi::xml_node& element, VtkEncoding& encoding);

}  // namespace isoatlas
