// A graph as VTU: points in physical coordinates, descending lines between them, array names of TTK, so that its ParaView states work.
// Sources: VTK file formats (docs.vtk.org); TTK's ttkContourTree (array names, type codes).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "formats/common/connectivity.h"
#include "formats/common/vtk_writer.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// TTK's CriticalType: the numbers are its codes.
enum class TtkType : std::int32_t { minimum = 0, saddle1 = 1, saddle2 = 2, maximum = 3, degenerate = 4, regular = 5 };

struct VtuPoint {
    Vec3 position;  ///< voxel coordinates
    double value;   ///< reported
    TtkType type;
};

/// Line i goes from upper[i] down to lower[i].
struct VtuLines {
    std::vector<std::int64_t> item, upper, lower;  ///< item: what the line represents

    void add(std::int64_t the_item, std::int64_t the_upper, std::int64_t the_lower) {
        item.push_back(the_item), upper.push_back(the_upper), lower.push_back(the_lower);
    }
};

/// get(i) for every i below count.
template <class T, class Get>
[[nodiscard]] std::string counted_array(AppendedArrays& arrays, const char* name, std::int64_t count, const Get& get) {
    return arrays.add<T>(name, 1, count, [=](ByteWriter& data) {
        for (std::int64_t i = 0; i < count; ++i) data.put(static_cast<T>(get(i)));
    });
}

class VtuGraph {
public:
    using At = std::function<VtuPoint(std::int64_t)>;
    /// at: the point of an index below `points`; called again for every array, so that a large graph is not copied.
    VtuGraph(std::int64_t points, At at, VtuLines lines) : points_(points), at_(std::move(at)), lines_(std::move(lines)) {}

    /// One more array with get(point) for every point.
    template <class T, class Get>
    void point_array(const char* name, const Get& get) {
        point_arrays_.push_back([=, count = points_](AppendedArrays& arrays) { return counted_array<T>(arrays, name, count, get); });
    }
    /// One more array with get(item) for every line.
    template <class T, class Get>
    void line_array(const char* name, const Get& get) {
        line_arrays_.push_back([=](AppendedArrays& arrays, const std::vector<std::int64_t>& items) {
            return counted_array<T>(arrays, name, static_cast<std::int64_t>(items.size()),
                                    [get, &items](std::int64_t i) { return get(items[static_cast<std::size_t>(i)]); });
        });
    }
    /// Writes the whole file: the arrays of every graph (NodeId, Scalar, CriticalType; SegmentationId, upNodeId, downNodeId,
    /// RegionSpan, ValueSpan, RegionType) and the added ones.
    void write(Sink& sink, const VolumeInfo& info, const Connectivity& connectivity) const;

private:
    using PointArray = std::function<std::string(AppendedArrays&)>;
    using LineArray = std::function<std::string(AppendedArrays&, const std::vector<std::int64_t>& items)>;

    [[nodiscard]] bool has_vertices() const { return lines_.item.empty(); }  ///< without lines: vertices, so that the points are visible
    [[nodiscard]] std::int64_t cells() const { return has_vertices() ? points_ : static_cast<std::int64_t>(lines_.item.size()); }
    void put_point_arrays(ByteWriter& out, AppendedArrays& arrays) const;
    void put_line_arrays(ByteWriter& out, AppendedArrays& arrays, const Geometry& geometry) const;
    void put_cells(ByteWriter& out, AppendedArrays& arrays) const;

    std::int64_t points_;
    At at_;
    VtuLines lines_;
    std::vector<PointArray> point_arrays_;
    std::vector<LineArray> line_arrays_;
};

}  // namespace isoatlas
