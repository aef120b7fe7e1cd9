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

using Point = std::array<double, 3>;

/// Unit normal of the stored triangle; zero for a degenerate one, as the format requires.
std::array<float, 3> facet_normal(const Point& a, const Point& b, const Point& c) {
    const Point u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const Point n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    if (!(length > 0)) return {0, 0, 0};
    return to_float({n[0] / length, n[1] / length, n[2] / length});
}

std::string header_words(const Surface& surface, std::string (*number)(double)) {
    const Connectivity connectivity = connectivity_of(surface);
    std::string text = std::string(kGenerator) + " tau " + number(surface.reported_tau) + " " + connectivity.name();
    if (connectivity.has_tunnels()) text += " tunnel_height " + number(connectivity.tunnel_height);
    text += " space " + one_line(surface.space);
    return surface.unit.empty() ? text : text + " unit " + one_line(surface.unit);
}

/// 80 bytes; must not start with "solid" (that announces the text form). Short numbers, so that none is truncated.
std::string header(const Surface& surface) {
    std::string text = header_words(surface, number_text);
    if (text.size() > 80) text = header_words(surface, short_text);
    text.resize(utf8_prefix(text, 80).size());
    text.resize(80, '\0');
    return text;
}

}  // namespace

void write_stl(Sink& sink, const Surface& surface, Warnings& warnings) {
    const std::size_t triangles = surface.triangles.size();
    if (triangles > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorKind::usage, {.file = sink.name(),
                                       .what = "STL counts its triangles with 32 bits, and the surface has " + std::to_string(triangles),
                                       .next = "write .vtp, or extract one object at a time"});
    }
    warnings.push_back("STL keeps no object ids and no unit of length; .ply keeps both");
    if (const std::int64_t merged = points_merged_by_float32(surface.points); merged > 0) {
        warnings.push_back("the float32 coordinates of STL merge " + std::to_string(merged) +
                           " points with a neighbour: the surface may no longer be a manifold; .ply and .vtp keep float64");
    }
    ByteWriter out(sink);
    out.text(header(surface));
    out.put(static_cast<std::uint32_t>(triangles));
    for (const auto& t : surface.triangles) {
        out.put(facet_normal(surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]));
        for (const std::int64_t p : t) out.put(to_float(surface.points[p]));
        out.put(std::uint16_t{0});
    }
    out.finish();
}

}  // namespace isoatlas
