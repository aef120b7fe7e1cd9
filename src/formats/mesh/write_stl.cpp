// STL, binary: triangles with a facet normal. It keeps no ids, no units and no shared points.
#include <cmath>
#include <limits>

#include "formats/common/byte_writer.h"
#include "formats/common/connectivity.h"
#include "formats/common/generator.h"
#include "formats/common/precision.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

using Corner = std::array<double, 3>;

/// Unit normal of the stored triangle; zero for a degenerate one, as the format requires.
std::array<float, 3> facet_normal(const Corner& a, const Corner& b, const Corner& c) {
    const Corner u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const Corner n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    if (!(length > 0)) return {0, 0, 0};
    return to_float({n[0] / length, n[1] / length, n[2] / length});
}

/// 3D Slicer looks for "SPACE=LPS" or "SPACE=RAS": first, because the end may be cut off.
std::string header_words(const MeshParts& parts, const char* generator, std::string (*number)(double)) {
    const Surface& first = parts.parts.front().surface();
    const Connectivity connectivity = connectivity_of(parts);
    std::string text = generator;
    if (parts.says_space()) text += " SPACE=" + parts.space;
    if (!parts.named) text += " tau " + number(first.reported_tau);
    text += std::string(" ") + connectivity.name();
    if (connectivity.has_tunnels()) text += " tunnel_height " + number(connectivity.tunnel_height);
    if (connectivity.is_low()) text += " low";
    if (!parts.says_space()) text += " space " + one_line(parts.space);
    return parts.unit.empty() ? text : text + " unit " + one_line(parts.unit);
}

/// 80 bytes; must not start with "solid" (that announces the text form). Short numbers, so that none is truncated.
std::string header(const MeshParts& parts) {
    std::string text = header_words(parts, kGenerator, number_text);
    if (text.size() > 80) text = header_words(parts, kGenerator, short_text);
    if (text.size() > 80) text = header_words(parts, "isoatlas", short_text);
    text.resize(utf8_prefix(text, 80).size());
    text.resize(80, '\0');
    return text;
}

std::int64_t merged_points(const MeshParts& parts) {
    std::int64_t merged = 0;
    for (const MeshPart& part : parts.parts) merged += points_merged_by_float32(part.surface().points);
    return merged;
}

}  // namespace

void write_stl(Sink& sink, const MeshParts& parts, Warnings& warnings) {
    if (parts.triangles > std::int64_t{std::numeric_limits<std::uint32_t>::max()}) {
        throw Error(ErrorKind::usage,
                    {.file = sink.name(),
                     .what = "STL counts its triangles with 32 bits, and the surface has " + std::to_string(parts.triangles),
                     .next = "write .vtp, or extract one object at a time"});
    }
    warnings.push_back(parts.named ? "STL keeps no names, no colours and no unit of length: the objects are one mesh; .ply keeps them apart"
                                   : "STL keeps no object ids and no unit of length; .ply keeps both");
    if (const std::int64_t merged = merged_points(parts); merged > 0) {
        warnings.push_back("the float32 coordinates of STL merge " + std::to_string(merged) +
                           " points with a neighbour: the surface may no longer be a manifold; .ply and .vtp keep float64");
    }
    ByteWriter out(sink);
    out.text(header(parts));
    out.put(static_cast<std::uint32_t>(parts.triangles));
    for (const MeshPart& part : parts.parts) {
        for (std::size_t i = 0; i < part.surface().triangles.size(); ++i) {
            const auto t = part.turned.triangle(i);
            const Corner a = part.turned.point(t[0]), b = part.turned.point(t[1]), c = part.turned.point(t[2]);
            out.put(facet_normal(a, b, c));
            for (const Corner& p : {a, b, c}) out.put(to_float(p));
            out.put(std::uint16_t{0});
        }
    }
    out.finish();
}

}  // namespace isoatlas
