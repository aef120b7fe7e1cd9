// What the fuzz targets of the mesh parsers share: input and unsupported are the only ways to refuse, a mesh that comes out is well-formed.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "formats/mesh/mesh_formats.h"
#include "isoatlas/error.h"

namespace fuzz {

inline void require(bool condition) {
    if (!condition) std::abort();
}

template <class Parse>
int parse_mesh(const Parse& parse, const std::uint8_t* data, std::size_t size) {
    try {
        const isoatlas::Mesh mesh = parse(std::string_view(reinterpret_cast<const char*>(data), size), std::string("fuzz"));
        const auto points = static_cast<std::int64_t>(mesh.points.size());
        for (const auto& triangle : mesh.triangles) {
            for (const std::int64_t p : triangle) require(p >= 0 && p < points);
        }
        for (const auto& p : mesh.points) require(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
        require(mesh.object.empty() || mesh.object.size() == mesh.points.size());
        require(mesh.contour.empty() || mesh.contour.size() == mesh.points.size());
    } catch (const isoatlas::Error& error) {
        require(error.kind() == isoatlas::ErrorKind::input || error.kind() == isoatlas::ErrorKind::unsupported);
    }
    return 0;
}

}  // namespace fuzz
