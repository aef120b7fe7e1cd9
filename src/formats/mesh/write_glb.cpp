// GLB: glTF 2.0 in one binary file. One node with its own mesh per object; positions are float32 relative to the node's translation,
// so objects far from the origin keep their shape. Lengths stay in the unit of the volume (extras), glTF's metres notwithstanding.
// Source: glTF 2.0 specification, Khronos Group.
#include <algorithm>
#include <limits>

#include "formats/common/byte_writer.h"
#include "formats/common/connectivity.h"
#include "formats/common/generator.h"
#include "formats/common/json_stream.h"
#include "formats/common/precision.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

using Point = std::array<double, 3>;

constexpr int kFloat = 5126, kUnsignedInt = 5125, kVertices = 34962, kIndices = 34963;

/// The mesh of one object: its points in the order of the surface, its triangles as a range of groups.order.
struct Part {
    ObjectGroups::Group group;
    std::size_t first_point, point_count;  ///< range of Scene::used
    Point translation;                     ///< middle of its box
    std::array<float, 3> low, high;        ///< of the stored positions
};

struct Scene {
    const Surface& surface;
    ObjectGroups groups;
    std::vector<std::int64_t> used;
    std::vector<Part> parts;
    std::int64_t bytes = 0;  ///< of the binary chunk
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

void place(const Scene& scene, Part& part) {
    const auto point = [&](std::size_t i) { return scene.surface.points[scene.used[part.first_point + i]]; };
    Point low = point(0), high = low;
    for (std::size_t i = 1; i < part.point_count; ++i) widen(low, high, point(i));
    for (std::size_t a = 0; a < 3; ++a) part.translation[a] = low[a] / 2 + high[a] / 2;
    part.low = part.high = relative(point(0), part.translation);
    for (std::size_t i = 1; i < part.point_count; ++i) widen(part.low, part.high, relative(point(i), part.translation));
}

Scene make_scene(const Surface& surface) {
    Scene scene{surface, group_by_object(surface), {}, {}, 0};
    for (const ObjectGroups::Group& group : scene.groups.groups) {
        const auto first = static_cast<std::ptrdiff_t>(scene.used.size());
        for (std::int64_t i = group.first; i < group.first + group.count; ++i) {
            const auto& triangle = surface.triangles[scene.groups.order[i]];
            scene.used.insert(scene.used.end(), triangle.begin(), triangle.end());
        }
        std::sort(scene.used.begin() + first, scene.used.end());
        scene.used.erase(std::unique(scene.used.begin() + first, scene.used.end()), scene.used.end());
        Part part{group, static_cast<std::size_t>(first), scene.used.size() - static_cast<std::size_t>(first), {}, {}, {}};
        place(scene, part);
        scene.parts.push_back(part);
        scene.bytes += static_cast<std::int64_t>(part.point_count) * (surface.normals.empty() ? 12 : 24) + 12 * group.count;
    }
    return scene;
}

void put_origin(JsonStream& json, const Surface& surface) {
    json.key("tau").value(surface.reported_tau).key("space").value(surface.space);
    json.key("unit");
    surface.unit.empty() ? json.null() : json.value(surface.unit);
    put_members(json, connectivity_of(surface));
}

std::string part_name(const Scene& scene, const Part& part) {
    return scene.groups.has_ids ? "object_" + std::to_string(part.group.object) : "surface";
}

void put_nodes(JsonStream& json, const Scene& scene) {
    json.line().key("nodes").begin_array();
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        const Part& part = scene.parts[i];
        json.line()
            .begin_object()
            .key("name")
            .value(part_name(scene, part))
            .key("mesh")
            .value(i)
            .key("translation")
            .value(part.translation);
        json.key("extras").begin_object();
        if (scene.groups.has_ids) json.key("object").value(part.group.object);
        put_origin(json, scene.surface);
        json.end_object().end_object();
    }
    json.end_array();
}

void put_meshes(JsonStream& json, const Scene& scene) {
    const std::size_t each = scene.surface.normals.empty() ? 2 : 3;
    json.line().key("meshes").begin_array();
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        json.line().begin_object().key("name").value(part_name(scene, scene.parts[i]));
        json.key("primitives").begin_array().begin_object().key("attributes").begin_object();
        json.key("POSITION").value(each * i);
        if (each == 3) json.key("NORMAL").value(each * i + 1);
        json.end_object().key("indices").value(each * i + each - 1).end_object().end_array().end_object();
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
    for (const Part& part : scene.parts) {
        const auto points = static_cast<std::int64_t>(part.point_count);
        put_accessor(json, view++, kFloat, points, "VEC3");
        json.key("min").begin_array();
        for (const float x : part.low) json.value(static_cast<double>(x));
        json.end_array().key("max").begin_array();
        for (const float x : part.high) json.value(static_cast<double>(x));
        json.end_array().end_object();
        if (!scene.surface.normals.empty()) {
            put_accessor(json, view++, kFloat, points, "VEC3");
            json.end_object();
        }
        put_accessor(json, view++, kUnsignedInt, 3 * part.group.count, "SCALAR");
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
    for (const Part& part : scene.parts) {
        const auto points = static_cast<std::int64_t>(part.point_count);
        put_view(12 * points, kVertices);
        if (!scene.surface.normals.empty()) put_view(12 * points, kVertices);
        put_view(12 * part.group.count, kIndices);
    }
    json.end_array();
}

/// The JSON chunk. glTF forbids empty arrays: a surface without triangles is a scene without nodes.
std::string scene_json(const Scene& scene) {
    std::string text;
    JsonStream json([&](std::string_view piece) { text += piece; });
    json.begin_object().key("asset").begin_object().key("version").value("2.0").key("generator").value(kGenerator);
    json.key("extras").begin_object();
    put_origin(json, scene.surface);
    json.end_object().end_object().line().key("scene").value(0).key("scenes").begin_array().begin_object();
    if (!scene.parts.empty()) {
        json.key("nodes").begin_array();
        for (std::size_t i = 0; i < scene.parts.size(); ++i) json.value(i);
        json.end_array();
    }
    json.end_object().end_array();
    if (!scene.parts.empty()) {
        put_nodes(json, scene);
        put_meshes(json, scene);
        put_accessors(json, scene);
        put_buffer_views(json, scene);
        json.line().key("buffers").begin_array().begin_object().key("byteLength").value(scene.bytes).end_object().end_array();
    }
    json.end_object().finish();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    return text;
}

void put_part(ByteWriter& out, const Scene& scene, const Part& part, std::vector<std::uint32_t>& local) {
    for (std::size_t i = 0; i < part.point_count; ++i) {
        const std::int64_t point = scene.used[part.first_point + i];
        local[point] = static_cast<std::uint32_t>(i);
        out.put(relative(scene.surface.points[point], part.translation));
    }
    for (std::size_t i = 0; i < part.point_count && !scene.surface.normals.empty(); ++i) {
        out.put(scene.surface.normals[scene.used[part.first_point + i]]);
    }
    for (std::int64_t i = part.group.first; i < part.group.first + part.group.count; ++i) {
        for (const std::int64_t point : scene.surface.triangles[scene.groups.order[i]]) out.put(local[point]);
    }
}

std::int64_t merged_points(const Scene& scene) {
    std::int64_t merged = 0;
    std::vector<Point> points;
    for (const Part& part : scene.parts) {
        points.clear();
        for (std::size_t i = part.first_point; i < part.first_point + part.point_count; ++i) {
            const Point& p = scene.surface.points[scene.used[i]];
            points.push_back({p[0] - part.translation[0], p[1] - part.translation[1], p[2] - part.translation[2]});
        }
        merged += points_merged_by_float32(points);
    }
    return merged;
}

}  // namespace

void write_glb(Sink& sink, const Surface& surface, Warnings& warnings) {
    const Scene scene = make_scene(surface);
    const std::string json = scene_json(scene);
    const std::int64_t chunks = 12 + 8 + static_cast<std::int64_t>(json.size()) + (scene.bytes > 0 ? 8 + scene.bytes : 0);
    if (chunks > std::int64_t{std::numeric_limits<std::uint32_t>::max()}) {
        throw Error(ErrorKind::usage,
                    {.file = sink.name(),
                     .what = "a GLB file holds at most 4 GiB, and this surface takes " + std::to_string(chunks) + " bytes",
                     .next = "write .vtp or .ply, or extract one object at a time"});
    }
    if (has_inner_contours(surface)) warnings.push_back("GLB keeps object ids, but not contour ids; .ply and .vtp keep both");
    if (const std::int64_t merged = merged_points(scene); merged > 0) {
        warnings.push_back("the float32 coordinates of GLB merge " + std::to_string(merged) +
                           " points with a neighbour; .ply and .vtp keep float64");
    }
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
        std::vector<std::uint32_t> local(surface.points.size());
        for (const Part& part : scene.parts) put_part(out, scene, part, local);
    }
    out.finish();
}

}  // namespace isoatlas
