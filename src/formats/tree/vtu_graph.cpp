#include "formats/tree/vtu_graph.h"

#include <cmath>

namespace isoatlas {

namespace {

constexpr std::uint8_t kVertexCell = 1, kLineCell = 3;

/// TTK's ArcType.
enum class TtkArc : std::int32_t { to_minimum = 0, to_maximum = 1, saddle1 = 2, saddle2 = 3, saddle1_saddle2 = 4 };

TtkArc arc_type(TtkType upper, TtkType lower) {
    if (upper == TtkType::minimum || lower == TtkType::minimum) return TtkArc::to_minimum;
    if (upper == TtkType::maximum || lower == TtkType::maximum) return TtkArc::to_maximum;
    if (upper == TtkType::saddle1 && lower == TtkType::saddle1) return TtkArc::saddle1;
    return upper == TtkType::saddle2 && lower == TtkType::saddle2 ? TtkArc::saddle2 : TtkArc::saddle1_saddle2;
}

double distance(const Vec3& p, const Vec3& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

}  // namespace

void VtuGraph::put_point_arrays(ByteWriter& out, AppendedArrays& arrays) const {
    out.text(counted_array<std::int64_t>(arrays, "NodeId", points_, [](std::int64_t i) { return i; }));
    out.text(counted_array<double>(arrays, "Scalar", points_, [this](std::int64_t i) { return at_(i).value; }));
    out.text(counted_array<std::int32_t>(arrays, "CriticalType", points_, [this](std::int64_t i) { return at_(i).type; }));
    for (const PointArray& point_array : point_arrays_) out.text(point_array(arrays));
}

void VtuGraph::put_line_arrays(ByteWriter& out, AppendedArrays& arrays, const Geometry& geometry) const {
    if (has_vertices()) return;
    const auto add = [&]<class T, class Get>(T, const char* name, const Get& get) {
        out.text(counted_array<T>(arrays, name, cells(), [get](std::int64_t i) { return get(static_cast<std::size_t>(i)); }));
    };
    const auto ends = [this](std::size_t i) { return std::pair(at_(lines_.upper[i]), at_(lines_.lower[i])); };
    add(std::int64_t{}, "SegmentationId", [this](std::size_t i) { return lines_.item[i]; });
    add(std::int64_t{}, "upNodeId", [this](std::size_t i) { return lines_.upper[i]; });
    add(std::int64_t{}, "downNodeId", [this](std::size_t i) { return lines_.lower[i]; });
    add(double{}, "RegionSpan", [ends, &geometry](std::size_t i) {
        const auto [upper, lower] = ends(i);
        return distance(to_physical(geometry, upper.position), to_physical(geometry, lower.position));
    });
    add(double{}, "ValueSpan", [ends](std::size_t i) {
        const auto [upper, lower] = ends(i);
        return upper.value - lower.value;
    });
    add(std::int32_t{}, "RegionType", [ends](std::size_t i) {
        const auto [upper, lower] = ends(i);
        return arc_type(upper.type, lower.type);
    });
    for (const LineArray& line_array : line_arrays_) out.text(line_array(arrays, lines_.item));
}

void VtuGraph::put_cells(ByteWriter& out, AppendedArrays& arrays) const {
    const std::int64_t corners = has_vertices() ? 1 : 2;
    out.text(arrays.add<std::int64_t>("connectivity", 1, corners * cells(), [this](ByteWriter& data) {
        for (std::int64_t i = 0; i < points_ && has_vertices(); ++i) data.put(i);
        for (std::size_t i = 0; i < lines_.item.size(); ++i) {
            data.put(lines_.upper[i]);
            data.put(lines_.lower[i]);
        }
    }));
    out.text(counted_array<std::int64_t>(arrays, "offsets", cells(), [corners](std::int64_t i) { return corners * (i + 1); }));
    const std::uint8_t type = has_vertices() ? kVertexCell : kLineCell;
    out.text(counted_array<std::uint8_t>(arrays, "types", cells(), [type](std::int64_t) { return type; }));
}

void VtuGraph::write(Sink& sink, const VolumeInfo& info, const Connectivity& connectivity) const {
    ByteWriter out(sink);
    AppendedArrays arrays;
    out.text(vtk_file_begin("UnstructuredGrid") + "<UnstructuredGrid>\n<FieldData>\n" + vtk_string("Space", info.geometry.space));
    if (!info.geometry.unit.empty()) out.text(vtk_string("Unit", info.geometry.unit));
    out.text(vtk_elements(arrays, connectivity));
    out.text("</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(points_) + "\" NumberOfCells=\"" + std::to_string(cells()) +
             "\">\n");
    out.text("<PointData Scalars=\"CriticalType\">\n");
    put_point_arrays(out, arrays);
    out.text("</PointData>\n<CellData>\n");
    put_line_arrays(out, arrays, info.geometry);
    out.text("</CellData>\n<Points>\n" + arrays.add<double>("Points", 3, points_, [&](ByteWriter& data) {
        for (std::int64_t i = 0; i < points_; ++i) data.put(to_physical(info.geometry, at_(i).position));
    }));
    out.text("</Points>\n<Cells>\n");
    put_cells(out, arrays);
    out.text("</Cells>\n</Piece>\n</UnstructuredGrid>\n");
    arrays.write(out);
    out.text("</VTKFile>\n");
    out.finish();
}

}  // namespace isoatlas
