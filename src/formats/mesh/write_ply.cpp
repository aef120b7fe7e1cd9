// PLY, binary little endian. PLY has no 64-bit integers: ids are int when all fit, else double (exact up to 2^53).
#include <limits>
#include <span>

#include "formats/common/byte_writer.h"
#include "formats/common/precision.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

bool fit_int32(std::span<const std::int64_t> ids) {
    for (const std::int64_t id : ids) {
        if (id < std::numeric_limits<std::int32_t>::min() || id > std::numeric_limits<std::int32_t>::max()) return false;
    }
    return true;
}

struct PlyTypes {
    Real position;
    bool int_object, int_contour, int_index;
};

PlyTypes choose_types(const Surface& surface, const std::string& file) {
    const std::size_t points = surface.points.size();
    if (points > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorKind::usage, {.file = file,
                                       .what = "PLY numbers its points with 32 bits, and the surface has " + std::to_string(points),
                                       .next = "write .vtp, or extract one object at a time"});
    }
    return {position_precision(surface), fit_int32(surface.object), fit_int32(surface.contour),
            points <= std::size_t{std::numeric_limits<std::int32_t>::max()}};
}

std::string header(const Surface& surface, const PlyTypes& types) {
    const std::string real = types.position == Real::f64 ? "double" : "float";
    const std::string index = types.int_index ? "int" : "uint";
    std::string text = "ply\nformat binary_little_endian 1.0\n" + comment_lines(surface, "comment");
    text += "element vertex " + std::to_string(surface.points.size()) + "\n";
    for (const char* axis : {"x", "y", "z"}) text += "property " + real + " " + axis + "\n";
    if (!surface.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
    if (!surface.object.empty()) text += std::string("property ") + (types.int_object ? "int" : "double") + " object\n";
    if (!surface.contour.empty()) text += std::string("property ") + (types.int_contour ? "int" : "double") + " contour\n";
    if (surface.segments.empty()) {
        text += "element face " + std::to_string(surface.triangles.size()) + "\nproperty list uchar " + index + " vertex_indices\n";
    } else {
        text += "element edge " + std::to_string(surface.segments.size()) + "\nproperty " + index + " vertex1\nproperty " + index +
                " vertex2\n";
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

}  // namespace

void write_ply(Sink& sink, const Surface& surface, Warnings&) {
    const PlyTypes types = choose_types(surface, sink.name());
    ByteWriter out(sink);
    out.text(header(surface, types));
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        if (types.position == Real::f64) {
            out.put(surface.points[i]);
        } else {
            out.put(to_float(surface.points[i]));
        }
        if (!surface.normals.empty()) out.put(surface.normals[i]);
        if (!surface.object.empty()) put_id(out, surface.object[i], types.int_object);
        if (!surface.contour.empty()) put_id(out, surface.contour[i], types.int_contour);
    }
    for (const auto& triangle : surface.triangles) {
        if (!surface.segments.empty()) break;  // curves have no triangles
        out.put(std::uint8_t{3});
        for (const std::int64_t p : triangle) out.put(static_cast<std::uint32_t>(p));
    }
    for (const auto& segment : surface.segments) {
        for (const std::int64_t p : segment) out.put(static_cast<std::uint32_t>(p));
    }
    out.finish();
}

}  // namespace isoatlas
