// The header of a legacy VTK file (.vtk) with a regular or rectilinear grid, and where its samples lie.
// Source: VTK file formats, "Simple Legacy Formats", docs.vtk.org.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/common/byte_source.h"
#include "formats/common/wide_integers.h"
#include "formats/volume/vtk_geometry.h"

namespace isoatlas {

/// An array of a file.
struct VtkLegacyArray {
    std::string name{};
    std::optional<ValueType> type{};  ///< none: not one of the ten
    WideInteger wide = WideInteger::none;
    std::int64_t components = 1, tuples = 0;
    double slope = 1;                 ///< value = slope * number
    bool cells = false;               ///< of the cells, not of the points
    std::int64_t begin = 0, end = 0;  ///< of its bytes in the file
};

struct VtkLegacyFile {
    std::string path, title;
    bool binary = false;       ///< big endian; else text
    bool rectilinear = false;  ///< with coordinates instead of origin and spacing
    VtkExtent points;
    Vec3 origin{0, 0, 0}, spacing{1, 1, 1};
    std::array<VtkLegacyArray, 3> coordinates;
    std::optional<VtkLegacyArray> samples;  ///< the first array with one number for each point, else for each cell
    std::vector<std::string> others;        ///< names of the arrays before it

    /// The numbers of an array of a supported type, in the byte order of `is_big_endian()`.
    [[nodiscard]] std::unique_ptr<ByteSource> open(const VtkLegacyArray& array) const;
    [[nodiscard]] bool is_big_endian() const;
};

/// Reads up to the end of the samples: text is read through, binary arrays are jumped over. Throws Error: input, unsupported.
[[nodiscard]] VtkLegacyFile read_vtk_legacy(const std::string& path);

}  // namespace isoatlas
