// OBJ (Wavefront): text, one `o object_<id>` for each object. Numbers are the shortest that read back as the same value.
#include <algorithm>

#include "formats/common/byte_writer.h"
#include "formats/common/precision.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

template <class T>
void put_line(ByteWriter& out, const char* keyword, const std::array<T, 3>& values) {
    out.text(keyword);
    for (const T value : values) {
        out.text(" ");
        out.number(value);
    }
    out.text("\n");
}

void put_points(ByteWriter& out, const MeshParts& parts) {
    const bool wide = position_precision(parts) == Real::f64;
    for (const MeshPart& part : parts.parts) {
        for (std::size_t i = 0; i < part.surface().points.size(); ++i) {
            if (wide) {
                put_line(out, "v", part.turned.point(i));
            } else {
                put_line(out, "v", to_float(part.turned.point(i)));
            }
        }
    }
    for (const MeshPart& part : parts.parts) {
        for (std::size_t i = 0; i < part.surface().normals.size() && parts.has_normals; ++i) put_line(out, "vn", part.turned.normal(i));
    }
}

template <std::size_t N>
void put_cell(ByteWriter& out, const std::array<std::int64_t, N>& cell, std::int64_t first_point, bool normals) {
    out.text(N == 3 ? "f" : "l");
    for (const std::int64_t p : cell) {
        out.text(" ");
        out.number(first_point + p + 1);
        if (N == 3 && normals) {  // lines take no normals
            out.text("//");
            out.number(first_point + p + 1);
        }
    }
    out.text("\n");
}

/// One word: some readers take no more.
std::string group_name(const MeshPart& part, const std::string& otherwise) {
    std::string name = part.name.empty() ? otherwise : part.name;
    std::ranges::replace(name, ' ', '_');
    return name;
}

void put_faces(ByteWriter& out, const MeshParts& parts, const MeshPart& part) {
    const ObjectGroups groups = parts.named ? one_group(part.surface()) : group_by_object(part.surface());
    for (const ObjectGroups::Group& group : groups.groups) {
        out.text("o " + group_name(part, groups.has_ids ? "object_" + std::to_string(group.object) : "surface") + "\n");
        for (std::int64_t i = group.first; i < group.first + group.count; ++i) {
            const auto cell = static_cast<std::size_t>(groups.order[i]);
            if (!parts.is_curves()) {
                put_cell(out, part.turned.triangle(cell), part.first_point, parts.has_normals);
            } else {
                put_cell(out, part.turned.segment(cell), part.first_point, false);
            }
        }
    }
}

}  // namespace

void write_obj(Sink& sink, const MeshParts& parts, Warnings& warnings) {
    if (has_inner_contours(parts)) warnings.push_back("OBJ keeps object ids, but not contour ids; .ply and .vtp keep both");
    if (parts.named) warnings.push_back("OBJ keeps the names of the objects as groups, but no colours; .glb keeps both");
    ByteWriter out(sink);
    out.text(comment_lines(parts, "#"));
    put_points(out, parts);
    for (const MeshPart& part : parts.parts) put_faces(out, parts, part);
    out.finish();
}

}  // namespace isoatlas
