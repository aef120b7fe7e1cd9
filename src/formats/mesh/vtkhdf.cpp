#include "formats/mesh/vtkhdf.h"

#include "formats/common/connectivity.h"

namespace isoatlas {

namespace {

constexpr const char* kRoot = "/VTKHDF";

std::string in_root(const std::string& name) { return std::string(kRoot) + "/" + name; }

/// put(out, part, i): point i of a part.
template <class Put>
std::function<void(ByteWriter&)> each_point(const MeshParts& parts, const Put& put) {
    return [&parts, put](ByteWriter& out) {
        for (const MeshPart& part : parts.parts) {
            for (std::size_t i = 0; i < part.surface().points.size(); ++i) put(out, part, i);
        }
    };
}

std::function<void(ByteWriter&)> one_number(std::int64_t number) {
    return [number](ByteWriter& out) { out.put(number); };
}

void add_points(std::vector<VtkhdfArray>& arrays, const MeshParts& parts, Real position) {
    const bool wide = position == Real::f64;
    arrays.push_back({in_root("NumberOfPoints"), "int64", 1, 1, false, one_number(parts.points)});
    arrays.push_back({in_root("Points"), wide ? "float64" : "float32", 3, parts.points, true,
                      each_point(parts, [wide](ByteWriter& out, const MeshPart& part, std::size_t i) {
                          const std::array<double, 3> point = part.turned.point(i);
                          if (wide) {
                              out.put(point);
                          } else {
                              out.put(to_float(point));
                          }
                      })});
}

void add_point_data(std::vector<VtkhdfArray>& arrays, const MeshParts& parts) {
    const std::string group = in_root("PointData/");
    const auto add = [&](const char* name, const char* type, std::int64_t columns, const auto& put) {
        arrays.push_back({group + name, type, columns, parts.points, true, each_point(parts, put)});
    };
    if (parts.named) {
        add("Object", "int64", 1, [&parts](ByteWriter& out, const MeshPart& part, std::size_t) {
            out.put(static_cast<std::int64_t>(&part - parts.parts.data()) + 1);
        });
        add("Colour", "uint8", 3, [](ByteWriter& out, const MeshPart& part, std::size_t) { out.put(part.colour); });
    }
    if (parts.has_object)
        add("ObjectId", "int64", 1, [](ByteWriter& out, const MeshPart& part, std::size_t i) { out.put(part.surface().object[i]); });
    if (parts.has_contour)
        add("ContourId", "int64", 1, [](ByteWriter& out, const MeshPart& part, std::size_t i) { out.put(part.surface().contour[i]); });
    if (parts.has_normals)
        add("Normals", "float32", 3, [](ByteWriter& out, const MeshPart& part, std::size_t i) { out.put(part.turned.normal(i)); });
}

/// get(part): its cells, of `corners` points each.
template <class Get>
std::function<void(ByteWriter&)> each_cell(const MeshParts& parts, std::int64_t count, const Get& put_cells) {
    return [&parts, count, put_cells](ByteWriter& out) {
        if (count == 0) return;  // curves have no triangles
        for (const MeshPart& part : parts.parts) put_cells(out, part);
    };
}

void add_cells(std::vector<VtkhdfArray>& arrays, const char* kind, std::int64_t corners, std::int64_t count,
               std::function<void(ByteWriter&)> put) {
    const std::string group = in_root(kind) + "/";
    arrays.push_back({group + "NumberOfCells", "int64", 1, 1, false, one_number(count)});
    arrays.push_back({group + "NumberOfConnectivityIds", "int64", 1, 1, false, one_number(corners * count)});
    arrays.push_back({group + "Offsets", "int64", 1, count + 1, count > 0, [corners, count](ByteWriter& out) {
                          for (std::int64_t i = 0; i <= count; ++i) out.put(corners * i);
                      }});
    arrays.push_back({group + "Connectivity", "int64", 1, corners * count, count > 0, std::move(put)});
}

template <std::size_t N>
void put_corners(ByteWriter& out, const std::array<std::int64_t, N>& corners, std::int64_t first) {
    for (const std::int64_t p : corners) out.put(p + first);
}

}  // namespace

std::vector<VtkhdfArray> vtkhdf_arrays(const MeshParts& parts, Real position) {
    std::vector<VtkhdfArray> arrays;
    add_points(arrays, parts, position);
    add_point_data(arrays, parts);
    const auto lines = [](ByteWriter& out, const MeshPart& part) {
        for (std::size_t i = 0; i < part.surface().segments.size(); ++i) put_corners(out, part.turned.segment(i), part.first_point);
    };
    const auto polygons = [](ByteWriter& out, const MeshPart& part) {
        for (std::size_t i = 0; i < part.surface().triangles.size(); ++i) put_corners(out, part.turned.triangle(i), part.first_point);
    };
    for (std::size_t kind = 0; kind < kVtkhdfCells.size(); ++kind) {
        if (kind == kVtkhdfLines) {
            add_cells(arrays, kVtkhdfCells[kind], 2, parts.segments, each_cell(parts, parts.segments, lines));
        } else if (kind == kVtkhdfPolygons) {
            add_cells(arrays, kVtkhdfCells[kind], 3, parts.triangles, each_cell(parts, parts.triangles, polygons));
        } else {
            add_cells(arrays, kVtkhdfCells[kind], 1, 0, [](ByteWriter&) {});
        }
    }
    return arrays;
}

VtkhdfFields vtkhdf_fields(const MeshParts& parts) {
    const Connectivity connectivity = connectivity_of(parts);
    VtkhdfFields fields;
    fields.numbers.emplace_back("Tau", std::vector<double>{});
    for (const MeshPart& part : parts.parts) fields.numbers.back().second.push_back(part.surface().reported_tau);
    if (connectivity.has_tunnels()) fields.numbers.push_back({"TunnelHeight", {connectivity.tunnel_height}});
    const auto add = [&](const char* name, const std::string& text) { fields.texts.push_back({name, {decoded_text(text)}}); };
    add("Space", parts.space);
    if (parts.says_space()) add("SPACE", parts.space);
    if (!parts.unit.empty()) add("Unit", parts.unit);
    add("Interpolant", connectivity.name());
    if (connectivity.is_low()) add("Polarity", name_of(connectivity.polarity));
    if (!parts.named) return fields;
    fields.texts.emplace_back("ObjectName", std::vector<std::string>{});
    for (const MeshPart& part : parts.parts) fields.texts.back().second.push_back(decoded_text(part.name));
    return fields;
}

void place_array(Sink& sink, Hdf5Layout& layout, const std::string& name, const char* type, const std::vector<std::int64_t>& shape,
                 const std::function<void(ByteWriter&)>& put) {
    PlacedSink place(sink, layout.add(name, type, shape));
    ByteWriter out(place);
    put(out);
    out.finish();
}

void place_fields(Sink& sink, Hdf5Layout& layout, const VtkhdfFields& fields) {
    for (const auto& [name, numbers] : fields.numbers) {
        place_array(sink, layout, in_root("FieldData/" + name), "float64", {static_cast<std::int64_t>(numbers.size())},
                    [&numbers](ByteWriter& out) {
                        for (const double number : numbers) out.put(number);
                    });
    }
    for (const auto& [name, texts] : fields.texts) layout.add_texts(in_root("FieldData/" + name), texts);
}

void set_attributes(Hdf5Layout& layout, const MeshParts& parts) {
    layout.set_attribute(kRoot, "Version", std::array<std::int64_t, 2>{2, 0});
    layout.set_attribute(kRoot, "Type", "PolyData");
    const std::string scalars = parts.named ? "Object" : parts.has_object ? "ObjectId" : "";
    if (!scalars.empty()) layout.set_attribute(in_root("PointData"), "Scalars", scalars);
    if (parts.has_normals) layout.set_attribute(in_root("PointData"), "Normals", "Normals");
}

void finish_vtkhdf(Sink& sink, Hdf5Layout& layout) {
    for (const Hdf5Layout::Piece& piece : layout.finish()) sink.write_at(piece.offset, piece.bytes);
    if (const std::int64_t end = layout.size(); sink.size() < end) {  // HDF5 may have allocated more than it uses
        const std::byte zero{0};
        sink.write_at(end - 1, std::span(&zero, 1));
    }
}

}  // namespace isoatlas
