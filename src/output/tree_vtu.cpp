// The tree as VTU: points at the critical places in physical coordinates, lines between them, arrays named as TTK names them, so that
// its ParaView states work. Sources: VTK file formats (docs.vtk.org); TTK's ttkContourTree (array names, type codes).
#include <cmath>

#include "output/tree_formats.h"
#include "output/vtk_writer.h"

namespace isoatlas::output {

namespace {

constexpr std::uint8_t kVertexCell = 1, kLineCell = 3;

/// TTK's CriticalType: the numbers are its codes.
enum class TtkType : std::int32_t { minimum = 0, saddle1 = 1, saddle2 = 2, maximum = 3, degenerate = 4, regular = 5 };
/// TTK's ArcType.
enum class TtkArc : std::int32_t { to_minimum = 0, to_maximum = 1, saddle1 = 2, saddle2 = 3, saddle1_saddle2 = 4 };

/// A genus change has the Morse index of the merge (a handle: the Euler number falls) or the split (it rises) that it resembles.
TtkType type_of(const Event& e) {
    switch (e.kind) {
        case Criticality::maximum: return TtkType::maximum;
        case Criticality::minimum: return TtkType::minimum;
        case Criticality::merge: return TtkType::saddle2;
        case Criticality::split: return TtkType::saddle1;
        case Criticality::genus: return e.delta_chi < 0 ? TtkType::saddle2 : e.delta_chi > 0 ? TtkType::saddle1 : TtkType::degenerate;
        case Criticality::complex: break;
    }
    return TtkType::degenerate;
}

/// By the numbers of objects just above and low components just below. (2, 2) is the saddle of 2D, where TTK knows one kind only.
TtkType type_of(const Element& e) {
    if (e.h0 == 0) return TtkType::maximum;
    if (e.l0 == 0) return TtkType::minimum;
    if (e.l0 == 2) return TtkType::saddle1;
    return e.h0 == 2 ? TtkType::saddle2 : TtkType::regular;
}

TtkArc arc_type(TtkType upper, TtkType lower) {
    if (upper == TtkType::minimum || lower == TtkType::minimum) return TtkArc::to_minimum;
    if (upper == TtkType::maximum || lower == TtkType::maximum) return TtkArc::to_maximum;
    if (upper == TtkType::saddle1 && lower == TtkType::saddle1) return TtkArc::saddle1;
    return upper == TtkType::saddle2 && lower == TtkType::saddle2 ? TtkArc::saddle2 : TtkArc::saddle1_saddle2;
}

double distance(const Vec3& p, const Vec3& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

/// Line i goes from upper(i) down to lower(i).
struct Lines {
    std::vector<std::int64_t> item, upper, lower;  ///< item: the event or contour that the line stands for
};

Lines lines_of(const TreeView& tree) {
    Lines lines;
    const auto add = [&](std::int64_t item, std::int64_t upper, std::int64_t lower) {
        lines.item.push_back(item);
        lines.upper.push_back(upper);
        lines.lower.push_back(lower);
    };
    if (tree.options.detail == TreeDetail::events) {
        for (std::int64_t id = 0; id < tree.analysis.event_count(); ++id) {
            if (const std::int64_t parent = tree.analysis.event(id).parent; parent >= 0) add(id, id, parent);
        }
    } else if (tree.options.detail == TreeDetail::contours) {
        for (std::int64_t id = 0; id < tree.analysis.contour_arc_count(); ++id) {
            const ContourArc arc = tree.analysis.contour_arc(id);
            if (!tree.is_outside(arc.lower)) add(id, arc.upper, arc.lower);  // the outside has no place
        }
    }
    return lines;
}

class VtuWriter {
public:
    explicit VtuWriter(const TreeView& tree)
        : tree_(tree),
          lines_(lines_of(tree)),
          of_events_(tree.options.detail == TreeDetail::events),
          points_(of_events_ ? tree.analysis.event_count() : tree.analysis.element_count()) {}

    void write(ByteWriter& out) {
        out.text(vtk_file_begin("UnstructuredGrid") + "<UnstructuredGrid>\n<FieldData>\n" +
                 vtk_string("Space", tree_.volume.info.geometry.space));
        if (!tree_.volume.info.geometry.unit.empty()) out.text(vtk_string("Unit", tree_.volume.info.geometry.unit));
        out.text(vtk_elements(arrays_, tree_.connectivity()));
        out.text("</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(points_) + "\" NumberOfCells=\"" + std::to_string(cells()) +
                 "\">\n");
        out.text("<PointData Scalars=\"CriticalType\">\n");
        of_events_ ? put_event_arrays(out) : put_element_arrays(out);
        out.text("</PointData>\n<CellData>\n");
        put_cell_arrays(out);
        out.text("</CellData>\n<Points>\n" + arrays_.add<double>("Points", 3, points_, [this](ByteWriter& data) { put_points(data); }));
        out.text("</Points>\n<Cells>\n");
        put_cells(out);
        out.text("</Cells>\n</Piece>\n</UnstructuredGrid>\n");
        arrays_.write(out);
        out.text("</VTKFile>\n");
        out.finish();
    }

private:
    [[nodiscard]] bool has_vertices() const { return lines_.item.empty(); }  ///< without lines, so that there is something to see
    [[nodiscard]] std::int64_t cells() const { return has_vertices() ? points_ : static_cast<std::int64_t>(lines_.item.size()); }

    template <class T, class Get>
    void event_array(ByteWriter& out, const char* name, const Get& get) {
        out.text(arrays_.add<T>(name, 1, points_, [this, get](ByteWriter& data) {
            for (std::int64_t id = 0; id < points_; ++id) data.put(static_cast<T>(get(tree_.analysis.event(id))));
        }));
    }
    template <class T, class Get>
    void element_array(ByteWriter& out, const char* name, const Get& get) {
        out.text(arrays_.add<T>(name, 1, points_, [this, get](ByteWriter& data) {
            for (std::int64_t id = 0; id < points_; ++id) data.put(static_cast<T>(get(tree_.analysis.element(id))));
        }));
    }
    template <class T, class Get>
    void line_array(ByteWriter& out, const char* name, const Get& get) {
        out.text(arrays_.add<T>(name, 1, cells(), [this, get](ByteWriter& data) {
            for (std::size_t i = 0; i < lines_.item.size(); ++i) data.put(static_cast<T>(get(i)));
        }));
    }
    void put_node_ids(ByteWriter& out) {
        out.text(arrays_.add<std::int64_t>("NodeId", 1, points_, [this](ByteWriter& data) {
            for (std::int64_t id = 0; id < points_; ++id) data.put(id);
        }));
    }
    void put_event_arrays(ByteWriter& out) {
        put_node_ids(out);
        event_array<double>(out, "Scalar", [this](const Event& e) { return tree_.reported(e.value); });
        event_array<std::int32_t>(out, "CriticalType", [](const Event& e) { return type_of(e); });
        if (tree_.has_zones) {
            event_array<std::int64_t>(out, "RegionSize", [](const Event& e) { return e.zone.voxels; });
            event_array<std::int64_t>(out, "ObjectVoxels", [](const Event& e) { return e.object_voxels; });
        }
        event_array<std::int64_t>(out, "Chi", [](const Event& e) { return e.chi; });
        event_array<std::int64_t>(out, "Tunnels", [](const Event& e) { return e.b1; });
        event_array<std::int64_t>(out, "Cavities", [](const Event& e) { return e.b2; });
        event_array<std::int64_t>(out, "Contours", [](const Event& e) { return e.contours; });
    }
    void put_element_arrays(ByteWriter& out) {
        put_node_ids(out);
        element_array<double>(out, "Scalar", [this](const Element& e) { return tree_.reported(e.value); });
        element_array<std::int32_t>(out, "CriticalType", [](const Element& e) { return type_of(e); });
        element_array<std::int32_t>(out, "H0", [](const Element& e) { return e.h0; });
        element_array<std::int32_t>(out, "L0", [](const Element& e) { return e.l0; });
    }
    [[nodiscard]] TtkType node_type(std::int64_t id) const {
        return of_events_ ? type_of(tree_.analysis.event(id)) : type_of(tree_.analysis.element(id));
    }
    [[nodiscard]] double value(std::int64_t id) const {
        return tree_.reported(of_events_ ? tree_.analysis.event(id).value : tree_.analysis.element(id).value);
    }
    [[nodiscard]] Vec3 place(std::int64_t id) const {
        return to_physical(tree_.volume.info.geometry,
                           of_events_ ? tree_.analysis.event(id).position : tree_.analysis.element(id).position);
    }
    void put_cell_arrays(ByteWriter& out) {
        if (has_vertices()) return;
        line_array<std::int64_t>(out, "SegmentationId", [this](std::size_t i) { return lines_.item[i]; });
        line_array<std::int64_t>(out, "upNodeId", [this](std::size_t i) { return lines_.upper[i]; });
        line_array<std::int64_t>(out, "downNodeId", [this](std::size_t i) { return lines_.lower[i]; });
        line_array<double>(out, "RegionSpan", [this](std::size_t i) { return distance(place(lines_.upper[i]), place(lines_.lower[i])); });
        line_array<double>(out, "ValueSpan", [this](std::size_t i) { return value(lines_.upper[i]) - value(lines_.lower[i]); });
        line_array<std::int32_t>(out, "RegionType",
                                 [this](std::size_t i) { return arc_type(node_type(lines_.upper[i]), node_type(lines_.lower[i])); });
        if (!of_events_)
            line_array<std::int64_t>(out, "Genus", [this](std::size_t i) { return tree_.analysis.contour_arc(lines_.item[i]).genus; });
        if (of_events_ && tree_.has_zones) {
            line_array<std::int64_t>(out, "RegionSize", [this](std::size_t i) { return tree_.analysis.event(lines_.item[i]).zone.voxels; });
        }
    }
    void put_points(ByteWriter& data) const {
        for (std::int64_t id = 0; id < points_; ++id) data.put(place(id));
    }
    void put_cells(ByteWriter& out) {
        const std::int64_t corners = has_vertices() ? 1 : 2;
        out.text(arrays_.add<std::int64_t>("connectivity", 1, corners * cells(), [this](ByteWriter& data) {
            for (std::int64_t i = 0; i < points_ && has_vertices(); ++i) data.put(i);
            for (std::size_t i = 0; i < lines_.item.size(); ++i) {
                data.put(lines_.upper[i]);
                data.put(lines_.lower[i]);
            }
        }));
        out.text(arrays_.add<std::int64_t>("offsets", 1, cells(), [this, corners](ByteWriter& data) {
            for (std::int64_t i = 1; i <= cells(); ++i) data.put(corners * i);
        }));
        out.text(arrays_.add<std::uint8_t>("types", 1, cells(), [this](ByteWriter& data) {
            for (std::int64_t i = 0; i < cells(); ++i) data.put(has_vertices() ? kVertexCell : kLineCell);
        }));
    }

    const TreeView& tree_;
    Lines lines_;
    bool of_events_;
    std::int64_t points_;
    AppendedArrays arrays_;
};

}  // namespace

void write_tree_vtu(AtomicFile& file, const TreeView& tree) {
    ByteWriter out(file);
    VtuWriter(tree).write(out);
}

}  // namespace isoatlas::output
