// GLB: glTF 2.0 in one binary file. A node turns the space of the volume into metres with y up (gltf_frame.h); below it is a node with its
// own mesh and material for each object. Positions are float32 relative to the node's translation, so objects far from the origin keep
// their shape. Source: glTF 2.0 specification, Khronos Group.
#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/common/byte_writer.h"
#include "formats/common/connectivity.h"
#include "formats/common/generator.h"
#include "formats/common/json_stream.h"
#include "formats/common/length_unit.h"
#include "formats/mesh/gltf_frame.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

using Point = std::array<double, 3>;

constexpr int kFloat = 5126, kUnsignedInt = 5125, kVertices = 34962, kIndices = 34963;

/// The mesh of one object: its points in the order of the surface, its triangles as a range of the order of its surface.
struct Piece {
    std::size_t surface;  ///< of Scene::surfaces
    ObjectGroups::Group group;
    std::string name;
    std::int64_t object;  ///< id, or number of a named part; -1: none
    std::size_t material;
    std::size_t first_point = 0, point_count = 0;  ///< range of Scene::used
    Point translation{};                           ///< middle of its box
    std::array<float, 3> low{}, high{};            ///< of the stored positions
    double distance = 0;                           ///< from the exact surface
    std::vector<std::size_t> coarser{};            ///< the pieces that are drawn instead where it is small
    bool is_coarser = false;
};

struct Material {
    SrgbBytes colour;
    std::string name;
    bool is_open;
};

struct Scene {
    const MeshParts& parts;
    std::vector<const Surface*> surfaces;  ///< those of the parts, and coarser ones
    std::vector<ObjectGroups> groups;      ///< of each surface
    std::vector<std::int64_t> used;
    std::vector<Piece> pieces;
    std::vector<Material> materials;
    std::int64_t bytes = 0;  ///< of the binary chunk

    [[nodiscard]] const Surface& surface(const Piece& piece) const { return *surfaces[piece.surface]; }
    [[nodiscard]] std::int64_t triangle(const Piece& piece, std::int64_t i) const { return groups[piece.surface].order[i]; }
    [[nodiscard]] const Point& point(const Piece& piece, std::size_t i) const { return surface(piece).points[used[piece.first_point + i]]; }
};

std::array<float, 3> relative(const Point& point, const Point& translation) {
    return to_float({point[0] - translation[0], point[1] - translation[1], point[2] - translation[2]});
}

template <class Number>
void widen(std::array<Number, 3>& low, std::array<Number, 3>& high, const std::array<Number, 3>& point) {
    for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], point[a]);
        high[a] = std::max(high[a], point[a]);
    }
}

void place(const Scene& scene, Piece& piece) {
    Point low = scene.point(piece, 0), high = low;
    for (std::size_t i = 1; i < piece.point_count; ++i) widen(low, high, scene.point(piece, i));
    for (std::size_t a = 0; a < 3; ++a) piece.translation[a] = low[a] / 2 + high[a] / 2;
    piece.low = piece.high = relative(scene.point(piece, 0), piece.translation);
    for (std::size_t i = 1; i < piece.point_count; ++i) widen(piece.low, piece.high, relative(scene.point(piece, i), piece.translation));
}

void add_piece(Scene& scene, Piece piece) {
    const auto first = static_cast<std::ptrdiff_t>(scene.used.size());
    for (std::int64_t i = piece.group.first; i < piece.group.first + piece.group.count; ++i) {
        const auto& triangle = scene.surface(piece).triangles[scene.triangle(piece, i)];
        scene.used.insert(scene.used.end(), triangle.begin(), triangle.end());
    }
    std::sort(scene.used.begin() + first, scene.used.end());
    scene.used.erase(std::unique(scene.used.begin() + first, scene.used.end()), scene.used.end());
    piece.first_point = static_cast<std::size_t>(first);
    piece.point_count = scene.used.size() - piece.first_point;
    place(scene, piece);
    scene.bytes += static_cast<std::int64_t>(piece.point_count) * (scene.parts.has_normals ? 24 : 12) + 12 * piece.group.count;
    scene.pieces.push_back(std::move(piece));
}

std::size_t add_surface(Scene& scene, const Surface& surface) {
    scene.surfaces.push_back(&surface);
    scene.groups.push_back(scene.parts.named ? one_group(surface) : group_by_object(surface));
    return scene.surfaces.size() - 1;
}

/// The same objects in coarser versions of their surface; first_piece: of the surface.
void add_coarser(Scene& scene, const MeshPart& part, std::size_t first_piece) {
    const std::size_t end = scene.pieces.size();
    for (const SimplifiedSurface& version : part.coarser) {
        const std::size_t surface = add_surface(scene, version.surface);
        const std::vector<ObjectGroups::Group> groups = scene.groups[surface].groups;
        for (const ObjectGroups::Group& group : groups) {
            const auto is_of_object = [&](const Piece& piece) { return scene.parts.named || piece.group.object == group.object; };
            const auto begin = scene.pieces.begin();
            const auto found =
                std::find_if(begin + static_cast<std::ptrdiff_t>(first_piece), begin + static_cast<std::ptrdiff_t>(end), is_of_object);
            if (found == begin + static_cast<std::ptrdiff_t>(end)) continue;
            found->coarser.push_back(scene.pieces.size());
            Piece piece{surface, group, found->name + " coarser " + std::to_string(found->coarser.size()), found->object, found->material};
            piece.distance = version.distance;
            piece.is_coarser = true;
            add_piece(scene, std::move(piece));
        }
    }
}

/// Objects of one surface share the colours of objects; named parts have one material each.
Scene make_scene(const MeshParts& parts) {
    Scene scene{parts, {}, {}, {}, {}, {}, 0};
    for (std::size_t p = 0; p < parts.parts.size(); ++p) {
        const MeshPart& part = parts.parts[p];
        const std::size_t surface = add_surface(scene, part.surface()), first_piece = scene.pieces.size();
        const bool has_ids = scene.groups.back().has_ids, is_open = !part.surface().closed;
        const std::vector<ObjectGroups::Group> groups = scene.groups.back().groups;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            Piece piece{surface, groups[g], part.name, parts.named ? static_cast<std::int64_t>(p) + 1 : has_ids ? groups[g].object : -1, 0};
            if (!parts.named) piece.name = has_ids ? "object_" + std::to_string(groups[g].object) : "surface";
            const SrgbBytes colour = parts.named ? part.colour : object_colour(static_cast<std::int64_t>(g));
            const auto is_shared = [&](const Material& material) { return !parts.named && material.colour == colour; };
            auto found = std::ranges::find_if(scene.materials, is_shared);
            piece.material = static_cast<std::size_t>(found - scene.materials.begin());
            if (found == scene.materials.end())
                scene.materials.push_back({colour, parts.named ? part.name : "colour " + std::to_string(piece.material + 1), is_open});
            add_piece(scene, std::move(piece));
        }
        add_coarser(scene, part, first_piece);
    }
    return scene;
}

void put_space(JsonStream& json, const MeshParts& parts) {
    json.key("space").value(one_line(parts.parts.front().surface().space)).key("unit");
    parts.unit.empty() ? json.null() : json.value(one_line(parts.unit));
}

void put_origin(JsonStream& json, const MeshParts& parts, const Surface& surface) {
    json.key("tau").value(surface.reported_tau);
    put_space(json, parts);
    put_members(json, connectivity_of(surface));
}

/// Down to which part of the screen's area each version is to be drawn: until the next one is a pixel away from the exact surface on a
/// screen of 1080 lines. Then, after the extras, which versions there are. Source: glTF extension MSFT_lod.
void put_levels(JsonStream& json, const Scene& scene, const Piece& piece) {
    constexpr double kLines = 1080;
    if (!piece.coarser.empty()) {
        const Point size{piece.high[0] - piece.low[0], piece.high[1] - piece.low[1], piece.high[2] - piece.low[2]};
        const double across = std::hypot(size[0], size[1], size[2]);
        json.key("MSFT_screencoverage").begin_array();
        for (const std::size_t version : piece.coarser) {
            const double lines = std::min(1.0, across / scene.pieces[version].distance / kLines);
            json.value(lines * lines);
        }
        json.value(0).end_array();
    }
    json.end_object();
    if (piece.coarser.empty()) return;
    json.key("extensions").begin_object().key("MSFT_lod").begin_object().key("ids").begin_array();
    for (const std::size_t version : piece.coarser) json.value(version + 1);
    json.end_array().end_object().end_object();
}

/// Node 0 holds the others.
void put_nodes(JsonStream& json, const Scene& scene) {
    const MeshParts& parts = scene.parts;
    json.line().key("nodes").begin_array().line().begin_object().key("name").value("isoatlas").key("matrix");
    json.value(gltf_frame(parts.parts.front().surface().space, parts.unit)).key("children").begin_array();
    for (std::size_t i = 0; i < scene.pieces.size(); ++i) {
        if (!scene.pieces[i].is_coarser) json.value(i + 1);
    }
    json.end_array().key("extras").begin_object().key("frame").value(kVolumeFrame);
    put_space(json, parts);
    json.end_object().end_object();
    for (std::size_t i = 0; i < scene.pieces.size(); ++i) {
        const Piece& piece = scene.pieces[i];
        json.line().begin_object().key("name").value(piece.name).key("mesh").value(i).key("translation").value(piece.translation);
        json.key("extras").begin_object();
        if (piece.object >= 0) json.key("object").value(piece.object);
        put_origin(json, parts, scene.surface(piece));
        if (piece.is_coarser) json.key("distance").value(piece.distance);
        put_levels(json, scene, piece);
        json.end_object();
    }
    json.end_array();
}

void put_meshes(JsonStream& json, const Scene& scene) {
    const std::size_t each = scene.parts.has_normals ? 3 : 2;
    json.line().key("meshes").begin_array();
    for (std::size_t i = 0; i < scene.pieces.size(); ++i) {
        json.line().begin_object().key("name").value(scene.pieces[i].name);
        json.key("primitives").begin_array().begin_object().key("attributes").begin_object();
        json.key("POSITION").value(each * i);
        if (each == 3) json.key("NORMAL").value(each * i + 1);
        json.end_object().key("indices").value(each * i + each - 1).key("material").value(scene.pieces[i].material);
        json.end_object().end_array().end_object();
    }
    json.end_array();
}

/// glTF has linear light.
void put_materials(JsonStream& json, const Scene& scene) {
    json.line().key("materials").begin_array();
    for (const Material& material : scene.materials) {
        json.line().begin_object().key("name").value(material.name).key("pbrMetallicRoughness").begin_object();
        json.key("baseColorFactor").begin_array();
        for (const std::uint8_t channel : material.colour) json.value(to_linear(channel / 255.0));
        json.value(1).end_array().key("metallicFactor").value(0).key("roughnessFactor").value(0.6).end_object();
        if (material.is_open) json.key("doubleSided").value(true);
        json.end_object();
    }
    json.end_array();
}

void put_accessor(JsonStream& json, std::size_t view, int component, std::int64_t count, const char* type) {
    json.line().begin_object().key("bufferView").value(view).key("componentType").value(component).key("count").value(count);
    json.key("type").value(type);
}

void put_accessors(JsonStream& json, const Scene& scene) {
    std::size_t view = 0;
    json.line().key("accessors").begin_array();
    for (const Piece& piece : scene.pieces) {
        const auto points = static_cast<std::int64_t>(piece.point_count);
        put_accessor(json, view++, kFloat, points, "VEC3");
        json.key("min").begin_array();
        for (const float x : piece.low) json.value(static_cast<double>(x));
        json.end_array().key("max").begin_array();
        for (const float x : piece.high) json.value(static_cast<double>(x));
        json.end_array().end_object();
        if (scene.parts.has_normals) {
            put_accessor(json, view++, kFloat, points, "VEC3");
            json.end_object();
        }
        put_accessor(json, view++, kUnsignedInt, 3 * piece.group.count, "SCALAR");
        json.end_object();
    }
    json.end_array();
}

void put_buffer_views(JsonStream& json, const Scene& scene) {
    std::int64_t offset = 0;
    const auto put_view = [&](std::int64_t bytes, int target) {
        json.line().begin_object().key("buffer").value(0).key("byteOffset").value(offset).key("byteLength").value(bytes);
        json.key("target").value(target).end_object();
        offset += bytes;
    };
    json.line().key("bufferViews").begin_array();
    for (const Piece& piece : scene.pieces) {
        const auto points = static_cast<std::int64_t>(piece.point_count);
        put_view(12 * points, kVertices);
        if (scene.parts.has_normals) put_view(12 * points, kVertices);
        put_view(12 * piece.group.count, kIndices);
    }
    json.end_array();
}

/// The JSON chunk. glTF forbids empty arrays: a surface without triangles is a scene without nodes.
std::string scene_json(const Scene& scene) {
    const MeshParts& parts = scene.parts;
    std::string text;
    JsonStream json([&](std::string_view piece) { text += piece; });
    json.begin_object().key("asset").begin_object().key("version").value("2.0").key("generator").value(kGenerator);
    json.key("extras").begin_object();
    parts.named ? put_space(json, parts) : put_origin(json, parts, parts.parts.front().surface());
    json.end_object().end_object().line().key("scene").value(0).key("scenes").begin_array().begin_object();
    if (!scene.pieces.empty()) json.key("nodes").begin_array().value(0).end_array();
    json.end_object().end_array();
    if (parts.has_coarser()) json.key("extensionsUsed").begin_array().value("MSFT_lod").end_array();
    if (!scene.pieces.empty()) {
        put_nodes(json, scene);
        put_meshes(json, scene);
        put_materials(json, scene);
        put_accessors(json, scene);
        put_buffer_views(json, scene);
        json.line().key("buffers").begin_array().begin_object().key("byteLength").value(scene.bytes).end_object().end_array();
    }
    json.end_object().finish();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    return text;
}

void put_piece(ByteWriter& out, const Scene& scene, const Piece& piece, std::vector<std::uint32_t>& local) {
    const Surface& surface = scene.surface(piece);
    local.resize(std::max(local.size(), surface.points.size()));
    for (std::size_t i = 0; i < piece.point_count; ++i) {
        local[scene.used[piece.first_point + i]] = static_cast<std::uint32_t>(i);
        out.put(relative(scene.point(piece, i), piece.translation));
    }
    for (std::size_t i = 0; i < piece.point_count && scene.parts.has_normals; ++i) {
        out.put(surface.normals[scene.used[piece.first_point + i]]);
    }
    for (std::int64_t i = piece.group.first; i < piece.group.first + piece.group.count; ++i) {
        for (const std::int64_t point : surface.triangles[scene.triangle(piece, i)]) out.put(local[point]);
    }
}

std::int64_t merged_points(const Scene& scene) {
    std::int64_t merged = 0;
    std::vector<Point> points;
    for (const Piece& piece : scene.pieces) {
        points.clear();
        for (std::size_t i = 0; i < piece.point_count; ++i) {
            const Point& p = scene.point(piece, i);
            points.push_back({p[0] - piece.translation[0], p[1] - piece.translation[1], p[2] - piece.translation[2]});
        }
        merged += points_merged_by_float32(points);
    }
    return merged;
}

void warn(const Scene& scene, Warnings& warnings) {
    if (has_inner_contours(scene.parts)) warnings.push_back("GLB keeps object ids, but not contour ids; .ply and .vtp keep both");
    if (!metres_in(scene.parts.unit)) {
        const std::string unit = scene.parts.unit.empty() ? "the volume has no unit of length" : "the unit of length is not known";
        warnings.push_back(unit + ": GLB is in metres, and one unit is written as one millimetre");
    }
    if (const std::int64_t merged = merged_points(scene); merged > 0) {
        warnings.push_back("the float32 coordinates of GLB merge " + std::to_string(merged) +
                           " points with a neighbour; .ply and .vtp keep float64");
    }
}

}  // namespace

void write_glb(Sink& sink, const MeshParts& parts, Warnings& warnings) {
    const Scene scene = make_scene(parts);
    const std::string json = scene_json(scene);
    const std::int64_t chunks = 12 + 8 + static_cast<std::int64_t>(json.size()) + (scene.bytes > 0 ? 8 + scene.bytes : 0);
    if (chunks > std::int64_t{std::numeric_limits<std::uint32_t>::max()}) {
        throw Error(ErrorKind::usage,
                    {.file = sink.name(),
                     .what = "a GLB file holds at most 4 GiB, and this surface takes " + std::to_string(chunks) + " bytes",
                     .next = "write .vtp or .ply, or extract one object at a time"});
    }
    warn(scene, warnings);
    ByteWriter out(sink);
    out.text("glTF");
    out.put(std::uint32_t{2});
    out.put(static_cast<std::uint32_t>(chunks));
    out.put(static_cast<std::uint32_t>(json.size()));
    out.text("JSON");
    out.text(json);
    if (scene.bytes > 0) {
        out.put(static_cast<std::uint32_t>(scene.bytes));
        out.text(std::string_view("BIN\0", 4));
        std::vector<std::uint32_t> local;
        for (const Piece& piece : scene.pieces) put_piece(out, scene, piece, local);
    }
    out.finish();
}

}  // namespace isoatlas
