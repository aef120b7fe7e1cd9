// OBJ (Wavefront): text, one `o object_<id>` for each object. Numbers are the shortest that read back as the same value.
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

void put_points(ByteWriter& out, const Surface& surface) {
    const bool wide = position_precision(surface) == Real::f64;
    for (const auto& point : surface.points) {
        if (wide) {
            put_line(out, "v", point);
        } else {
            put_line(out, "v", to_float(point));
        }
    }
    for (const auto& normal : surface.normals) put_line(out, "vn", normal);
}

template <std::size_t N>
void put_cell(ByteWriter& out, const std::array<std::int64_t, N>& cell, bool normals) {
    out.text(N == 3 ? "f" : "l");
    for (const std::int64_t p : cell) {
        out.text(" ");
        out.number(p + 1);
        if (N == 3 && normals) {  // lines take no normals
            out.text("//");
            out.number(p + 1);
        }
    }
    out.text("\n");
}

}  // namespace

void write_obj(Sink& sink, const Surface& surface, Warnings& warnings) {
    if (has_inner_contours(surface)) warnings.push_back("OBJ keeps object ids, but not contour ids; .ply and .vtp keep both");
    ByteWriter out(sink);
    out.text(comment_lines(surface, "#"));
    put_points(out, surface);
    const ObjectGroups groups = group_by_object(surface);
    for (const ObjectGroups::Group& group : groups.groups) {
        out.text(groups.has_ids ? "o object_" + std::to_string(group.object) + "\n" : "o surface\n");
        for (std::int64_t i = group.first; i < group.first + group.count; ++i) {
            if (surface.segments.empty()) {
                put_cell(out, surface.triangles[groups.order[i]], !surface.normals.empty());
            } else {
                put_cell(out, surface.segments[groups.order[i]], false);
            }
        }
    }
    out.finish();
}

}  // namespace isoatlas
