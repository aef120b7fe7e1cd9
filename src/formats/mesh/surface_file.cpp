// write_surface and read_mesh: the extension chooses the format.
#include "base/atomic_file.h"
#include "formats/common/file_access.h"
#include "formats/common/file_extension.h"
#include "formats/mesh/mesh_formats.h"
#include "isoatlas/surface.h"

namespace isoatlas {

namespace {

struct MeshFormat {
    const char* extension;
    void (*write)(Sink&, const Surface&, Warnings&);
    Mesh (*parse)(std::string_view, const std::string&);
    bool curves;  ///< holds segments too
};

constexpr MeshFormat kFormats[] = {{".ply", write_ply, parse_ply, true},
                                   {".stl", write_stl, parse_stl, false},
                                   {".obj", write_obj, parse_obj, true},
                                   {".vtp", write_vtp, parse_vtp, true},
                                   {".glb", write_glb, parse_glb, false}};

const MeshFormat& format_of(const std::string& path) {
    const std::string extension = lower_extension(path);
    for (const MeshFormat& format : kFormats) {
        if (extension == format.extension) return format;
    }
    refuse_extension(path, {"the mesh format", "mesh format", ".ply, .stl, .obj, .vtp or .glb"});
}

/// The format, if it can hold the surface.
const MeshFormat& checked_format(const std::string& path, const Surface& surface) {
    const MeshFormat& format = format_of(path);
    if (!surface.segments.empty() && !format.curves) {
        throw Error(ErrorKind::usage,
                    {.file = path,
                     .what = std::string(format.extension) + " stores triangles only, and the contours of a 2D image are curves",
                     .next = "write .ply, .obj or .vtp"});
    }
    check_surface(surface, path);
    return format;
}

}  // namespace

std::vector<std::string> write_surface(Sink& sink, const Surface& surface) {
    const MeshFormat& format = checked_format(sink.name(), surface);
    Warnings warnings;
    format.write(sink, surface, warnings);
    return warnings;
}

std::vector<std::string> write_surface(const std::string& path, const Surface& surface) {
    const MeshFormat& format = checked_format(path, surface);
    Warnings warnings;
    AtomicFile file(path);
    format.write(file, surface, warnings);
    file.commit();
    return warnings;
}

namespace {

Surface joined(std::span<const NamedSurface> surfaces) {
    Surface all = surfaces.front().surface;
    for (const NamedSurface& named : surfaces.subspan(1)) {
        const Surface& s = named.surface;
        const auto shift = static_cast<std::int64_t>(all.points.size());
        all.points.insert(all.points.end(), s.points.begin(), s.points.end());
        all.normals.insert(all.normals.end(), s.normals.begin(), s.normals.end());
        all.object.insert(all.object.end(), s.object.begin(), s.object.end());
        all.contour.insert(all.contour.end(), s.contour.begin(), s.contour.end());
        for (const auto& t : s.triangles) all.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
        for (const auto& t : s.segments) all.segments.push_back({t[0] + shift, t[1] + shift});
    }
    return all;
}

}  // namespace

std::vector<std::string> write_surfaces(const std::string& path, std::span<const NamedSurface> surfaces) {
    return write_surface(path, joined(surfaces));
}

std::vector<std::string> write_surfaces(Sink& sink, std::span<const NamedSurface> surfaces) {
    return write_surface(sink, joined(surfaces));
}

Mesh read_mesh(const std::string& path) {
    const MeshFormat& format = format_of(path);
    std::string bytes;
    {
        const std::unique_ptr<File> file = open_file(path);
        bytes.resize(static_cast<std::size_t>(file->size()));
        read_fully(*file, path, 0, std::as_writable_bytes(std::span(bytes.data(), bytes.size())));
    }
    return format.parse(bytes, path);
}

}  // namespace isoatlas
