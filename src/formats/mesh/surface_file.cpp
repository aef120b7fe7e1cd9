// write_surface, write_surfaces and read_mesh: the extension chooses the format.
#include "base/atomic_file.h"
#include "formats/common/file_access.h"
#include "formats/common/file_extension.h"
#include "formats/mesh/mesh_formats.h"
#include "isoatlas/surface.h"

namespace isoatlas {

namespace {

struct MeshFormat {
    const char* extension;
    void (*write)(Sink&, const MeshParts&, Warnings&);
    Mesh (*parse)(std::string_view, const std::string&);  ///< null: it is not read
    bool curves;                                          ///< holds segments too
};

constexpr MeshFormat kFormats[] = {{".ply", write_ply, parse_ply, true},  {".stl", write_stl, parse_stl, false},
                                   {".obj", write_obj, parse_obj, true},  {".vtp", write_vtp, parse_vtp, true},
                                   {".glb", write_glb, parse_glb, false}, {".vtkhdf", write_vtkhdf, nullptr, true}};

const MeshFormat& format_of(const std::string& path) {
    const std::string extension = lower_extension(path);
    for (const MeshFormat& format : kFormats) {
        if (extension == format.extension) return format;
    }
    refuse_extension(path, {"the mesh format", "mesh format", ".ply, .stl, .obj, .vtp, .glb or .vtkhdf"});
}

/// The format, if it can hold the surfaces.
const MeshFormat& checked_format(const std::string& path, const MeshParts& parts) {
    const MeshFormat& format = format_of(path);
    if (parts.is_curves() && !format.curves) {
        throw Error(ErrorKind::usage,
                    {.file = path,
                     .what = std::string(format.extension) + " stores triangles only, and the contours of a 2D image are curves",
                     .next = "write .ply, .obj, .vtp or .vtkhdf"});
    }
    if (parts.has_coarser() && format.write != write_glb) {
        throw Error(
            ErrorKind::usage,
            {.file = path, .what = std::string(format.extension) + " holds no coarser versions of a surface", .next = "write .glb"});
    }
    return format;
}

Warnings write(Sink& sink, const MeshParts& parts) {
    Warnings warnings;
    checked_format(sink.name(), parts).write(sink, parts, warnings);
    return warnings;
}

Warnings write(const std::string& path, const MeshParts& parts) {
    (void)checked_format(path, parts);
    AtomicFile file(path);
    Warnings warnings = write(file, parts);
    file.commit();
    return warnings;
}

}  // namespace

std::vector<std::string> write_surface(Sink& sink, const Surface& surface, const SurfaceFileOptions& options) {
    (void)format_of(sink.name());
    return write(sink, mesh_parts(surface, options, sink.name()));
}

std::vector<std::string> write_surface(const std::string& path, const Surface& surface, const SurfaceFileOptions& options) {
    return write_surface(path, surface, std::span<const SimplifiedSurface>{}, options);
}

std::vector<std::string> write_surface(const std::string& path, const Surface& surface, std::span<const SimplifiedSurface> coarser,
                                       const SurfaceFileOptions& options) {
    (void)format_of(path);
    return write(path, mesh_parts(surface, options, path, coarser));
}

std::vector<std::string> write_surfaces(Sink& sink, std::span<const NamedSurface> surfaces, const SurfaceFileOptions& options) {
    (void)format_of(sink.name());
    return write(sink, mesh_parts(surfaces, options, sink.name()));
}

std::vector<std::string> write_surfaces(const std::string& path, std::span<const NamedSurface> surfaces,
                                        const SurfaceFileOptions& options) {
    (void)format_of(path);
    return write(path, mesh_parts(surfaces, options, path));
}

std::string space_in_file(const std::string& path, const std::string& space, const SurfaceFileOptions& options) {
    return lower_extension(path) == ".glb" ? "glTF" : turned_space(space, options.space);
}

Mesh read_mesh(const std::string& path) {
    const MeshFormat& format = format_of(path);
    if (format.parse == nullptr) {
        throw Error(ErrorKind::unsupported, {.file = path,
                                             .what = std::string(format.extension) + " is written, but not read",
                                             .next = "write the same surface as .vtp, .ply or .glb"});
    }
    std::string bytes;
    {
        const std::unique_ptr<File> file = open_file(path);
        bytes.resize(static_cast<std::size_t>(file->size()));
        read_fully(*file, path, 0, std::as_writable_bytes(std::span(bytes.data(), bytes.size())));
    }
    return format.parse(bytes, path);
}

}  // namespace isoatlas
