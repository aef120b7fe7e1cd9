// PLY, binary little endian. PLY has no 64-bit integers: ids are int when all fit, else double (exact up to 2^53).
#include <limits>

#include "formats/common/byte_writer.h"
#include "formats/common/precision.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

using Ids = Array<std::int64_t> Surface::*;

bool fit_int32(const MeshParts& parts, Ids ids) {
    for (const MeshPart& part : parts.parts) {
        for (const std::int64_t id : part.surface().*ids) {
            if (id < std::numeric_limits<std::int32_t>::min() || id > std::numeric_limits<std::int32_t>::max()) return false;
        }
    }
    return true;
}

struct PlyTypes {
    Real position;
    bool int_object, int_contour, int_index;
};

PlyTypes choose_types(const MeshParts& parts, const std::string& file) {
    if (parts.points > std::int64_t{std::numeric_limits<std::uint32_t>::max()}) {
        throw Error(ErrorKind::usage, {.file = file,
                                       .what = "PLY numbers its points with 32 bits, and the surface has " + std::to_string(parts.points),
                                       .next = "write .vtp, or extract one object at a time"});
    }
    return {position_precision(parts), parts.named || fit_int32(parts, &Surface::object), fit_int32(parts, &Surface::contour),
            parts.points <= std::int64_t{std::numeric_limits<std::int32_t>::max()}};
}

std::string header(const MeshParts& parts, const PlyTypes& types) {
    const std::string real = types.position == Real::f64 ? "double" : "float";
    const std::string index = types.int_index ? "int" : "uint";
    std::string text = "ply\nformat binary_little_endian 1.0\n" + comment_lines(parts, "comment");
    text += "element vertex " + std::to_string(parts.points) + "\n";
    for (const char* axis : {"x", "y", "z"}) text += "property " + real + " " + axis + "\n";
    if (parts.has_normals) text += "property float nx\nproperty float ny\nproperty float nz\n";
    if (parts.named) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    if (parts.named || parts.has_object) text += std::string("property ") + (types.int_object ? "int" : "double") + " object\n";
    if (parts.has_contour) text += std::string("property ") + (types.int_contour ? "int" : "double") + " contour\n";
    if (!parts.is_curves()) {
        text += "element face " + std::to_string(parts.triangles) + "\nproperty list uchar " + index + " vertex_indices\n";
    } else {
        text += "element edge " + std::to_string(parts.segments) + "\nproperty " + index + " vertex1\nproperty " + index + " vertex2\n";
    }
    return text + "end_header\n";
}

void put_id(ByteWriter& out, std::int64_t id, bool as_int) {
    if (as_int) {
        out.put(static_cast<std::int32_t>(id));
    } else {
        out.put(static_cast<double>(id));
    }
}

/// number: of the part, from 1.
void put_points(ByteWriter& out, const MeshParts& parts, const PlyTypes& types, std::size_t number) {
    const MeshPart& part = parts.parts[number - 1];
    const Surface& surface = part.surface();
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        if (types.position == Real::f64) {
            out.put(part.turned.point(i));
        } else {
            out.put(to_float(part.turned.point(i)));
        }
        if (parts.has_normals) out.put(part.turned.normal(i));
        if (parts.named) out.put(part.colour);
        if (parts.named || parts.has_object) {
            put_id(out, parts.named ? static_cast<std::int64_t>(number) : surface.object[i], types.int_object);
        }
        if (parts.has_contour) put_id(out, surface.contour[i], types.int_contour);
    }
}

void put_cells(ByteWriter& out, const MeshParts& parts, const MeshPart& part) {
    const auto put_corner = [&](std::int64_t p) { out.put(static_cast<std::uint32_t>(p + part.first_point)); };
    for (std::size_t t = 0; t < part.surface().triangles.size() && !parts.is_curves(); ++t) {  // curves have no triangles
        out.put(std::uint8_t{3});
        for (const std::int64_t p : part.turned.triangle(t)) put_corner(p);
    }
    for (std::size_t s = 0; s < part.surface().segments.size(); ++s) {
        for (const std::int64_t p : part.turned.segment(s)) put_corner(p);
    }
}

}  // namespace

void write_ply(Sink& sink, const MeshParts& parts, Warnings&) {
    const PlyTypes types = choose_types(parts, sink.name());
    ByteWriter out(sink);
    out.text(header(parts, types));
    for (std::size_t number = 1; number <= parts.parts.size(); ++number) put_points(out, parts, types, number);
    for (const MeshPart& part : parts.parts) put_cells(out, parts, part);
    out.finish();
}

}  // namespace isoatlas
