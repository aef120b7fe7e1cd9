// Extent and geometry of VTK XML grids.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "formats/common/vtk_array.h"
#include "isoatlas/volume.h"

namespace pugi {
class xml_node;
}

namespace isoatlas {

/// Points of a grid: low[a] to low[a] + size[a] - 1 along axis a.
struct VtkExtent {
    Index3 low{}, size{};
    /// Samples at the points, or in the cells between them; a single slice along z has rank 2 (VTK has no other notation).
    [[nodiscard]] Extent samples(bool cells) const;
};

/// The extent of the piece (of the grid when it has none). Throws Error{input} for anything but three ranges.
[[nodiscard]] VtkExtent read_vtk_extent(const std::string& path, const pugi::xml_node& grid, const pugi::xml_node& piece,
                                        std::vector<std::string>& notes);

/// Origin, Spacing and Direction of ImageData; the origin is moved to the first sample.
void set_image_geometry(const pugi::xml_node& grid, const VtkExtent& points, bool cells, VolumeInfo& info);

using CoordinateReader = std::function<std::vector<double>(const pugi::xml_node& array, std::int64_t count)>;
/// Coordinates of RectilinearGrid; they must ascend. Throws Error: input, unsupported.
[[nodiscard]] Geometry rectilinear_geometry(const std::string& path, const pugi::xml_node& piece, const VtkExtent& points, bool cells,
                                            const CoordinateReader& read);

/// The same from the coordinates of the points.
[[nodiscard]] Geometry rectilinear_geometry(const std::string& path, std::array<std::vector<double>, 3> coordinates, bool cells);

/// All numbers of a source, or of a data array, which are of this type.
[[nodiscard]] std::vector<double> read_doubles(const std::string& path, std::unique_ptr<ByteSource> numbers, ValueType type,
                                               bool big_endian, std::int64_t count, const OpenOptions& options = {});
[[nodiscard]] std::vector<double> read_doubles(const VtkFile& file, const VtkArray& array, ValueType type, std::int64_t count);

}  // namespace isoatlas
