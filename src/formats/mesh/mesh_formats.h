// The mesh formats behind write_surface and read_mesh: a writer and, but for VTKHDF, a parser each. docs/formats.md lists what each keeps.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/mesh/mesh_parts.h"
#include "isoatlas/sink.h"
#include "isoatlas/surface.h"

namespace isoatlas {

using Warnings = std::vector<std::string>;

// Each writes the whole file. STL and GLB take no segments. GLB has the points in the space of the volume.
void write_ply(Sink& sink, const MeshParts& parts, Warnings& warnings);
void write_stl(Sink& sink, const MeshParts& parts, Warnings& warnings);
void write_obj(Sink& sink, const MeshParts& parts, Warnings& warnings);
void write_vtp(Sink& sink, const MeshParts& parts, Warnings& warnings);
void write_glb(Sink& sink, const MeshParts& parts, Warnings& warnings);
void write_vtkhdf(Sink& sink, const MeshParts& parts, Warnings& warnings);

// Each parses a whole file. `file` is its name for messages. Throws Error: input, unsupported. The result is well-formed (check_mesh).
// Allocates in proportion to bytes.size() only.
[[nodiscard]] Mesh parse_ply(std::string_view bytes, const std::string& file);
[[nodiscard]] Mesh parse_stl(std::string_view bytes, const std::string& file);
[[nodiscard]] Mesh parse_obj(std::string_view bytes, const std::string& file);
[[nodiscard]] Mesh parse_vtp(std::string_view bytes, const std::string& file);
[[nodiscard]] Mesh parse_glb(std::string_view bytes, const std::string& file);

/// Throws Error{usage} for arrays of different length or indices out of range.
void check_surface(const Surface& surface, const std::string& file);
/// Throws Error{input} for a point that is not finite or an index out of range.
void check_mesh(const Mesh& mesh, const std::string& file);
/// Adds the triangles of a polygon: a fan around its first corner. Fewer than 3 corners add nothing.
void add_polygon(Mesh& mesh, const std::vector<std::int64_t>& corners);
/// Adds the triangles of a strip; every second one has the opposite orientation.
void add_strip(Mesh& mesh, const std::vector<std::int64_t>& corners);

/// What a comment says of space and unit, as comment_lines() and 3D Slicer write it: "space LPS", "unit mm", or "SPACE=LPS" somewhere in
/// it. Other texts change nothing.
void take_comment(Mesh& mesh, std::string_view text);

/// Triangles (or segments) in runs of one object: `order` lists them grouped by the object of their first point, objects in ascending
/// order, the surface's order kept inside. Without ids there is one group, and has_ids is false.
struct ObjectGroups {
    struct Group {
        std::int64_t object;
        std::int64_t first, count;  ///< range of order
    };
    std::vector<Group> groups;
    std::vector<std::int64_t> order;
    bool has_ids = false;
};
[[nodiscard]] ObjectGroups group_by_object(const Surface& surface);
/// All of the surface in one group, without ids.
[[nodiscard]] ObjectGroups one_group(const Surface& surface);
/// Whether some object has more than one contour, so that object ids alone do not identify the contour of a point.
[[nodiscard]] bool has_inner_contours(const MeshParts& parts);

}  // namespace isoatlas
