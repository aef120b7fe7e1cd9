// GLB: all triangles of the default scene, with the transforms of their nodes. Source: glTF 2.0 specification, Khronos Group.
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "formats/common/byte_cursor.h"
#include "formats/mesh/gltf_frame.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

using Json = nlohmann::json;
using Matrix = GltfMatrix;

constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
/// Nodes may share a mesh; more than this many times the size of the file is rejected (denial of service).
constexpr std::size_t kMaxInstances = 64;

struct Chunks {
    std::string_view json, binary;
};

[[noreturn]] void fail_glb(const std::string& file, std::string what, std::string where = {}) {
    throw Error(ErrorKind::input, {.file = file, .where = std::move(where), .what = std::move(what), .next = kDamagedFile});
}

[[noreturn]] void fail_unsupported(const std::string& file, std::string what) {
    throw Error(ErrorKind::unsupported, {.file = file, .what = std::move(what), .next = "export the mesh as plain GLB, or as PLY"});
}

Chunks split(std::string_view bytes, const std::string& file) {
    ByteCursor in(bytes, file);
    if (bytes.substr(0, 4) != "glTF") in.fail_at_offset("not a GLB file: it does not start with \"glTF\"");
    in.go_to(4);
    if (in.number<std::uint32_t>(false, "the header") != 2) in.fail_at_offset("not version 2 of glTF");
    const std::size_t total = in.number<std::uint32_t>(false, "the header");
    if (total > bytes.size()) in.fail_at_offset("the file is cut off", std::to_string(total) + " bytes");
    Chunks chunks;
    for (bool first = true; in.at() + 8 <= total; first = false) {
        const std::size_t size = in.number<std::uint32_t>(false, "a chunk");
        const std::string_view type = in.bytes(4, "a chunk");
        const std::string_view content = in.bytes(size, "a chunk");
        if (first && type != "JSON") in.fail_at_offset("the first chunk is not JSON");
        if (first) chunks.json = content;
        if (type == std::string_view("BIN\0", 4) && chunks.binary.empty()) chunks.binary = content;
    }
    if (chunks.json.empty()) in.fail_at_offset("the file has no JSON chunk");
    return chunks;
}

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t column = 0; column < 4; ++column) {
        for (std::size_t row = 0; row < 4; ++row) {
            for (std::size_t k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
        }
    }
    return c;
}

double determinant(const Matrix& m) {
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) + m[8] * (m[1] * m[6] - m[2] * m[5]);
}

std::array<double, 3> transformed(const Matrix& m, const std::array<double, 3>& p) {
    std::array<double, 3> q{};
    for (std::size_t row = 0; row < 3; ++row) q[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
    return q;
}

template <std::size_t N>
std::array<double, N> numbers(const Json& node, const char* key, const std::array<double, N>& otherwise) {
    const auto found = node.find(key);
    return found == node.end() ? otherwise : found->get<std::array<double, N>>();
}

/// matrix, or translation * rotation * scale.
Matrix local_transform(const Json& node) {
    if (node.contains("matrix")) return numbers<16>(node, "matrix", kIdentity);
    const auto t = numbers<3>(node, "translation", {0, 0, 0}), s = numbers<3>(node, "scale", {1, 1, 1});
    const auto [x, y, z, w] = numbers<4>(node, "rotation", {0, 0, 0, 1});
    return {(1 - 2 * (y * y + z * z)) * s[0],
            2 * (x * y + z * w) * s[0],
            2 * (x * z - y * w) * s[0],
            0,
            2 * (x * y - z * w) * s[1],
            (1 - 2 * (x * x + z * z)) * s[1],
            2 * (y * z + x * w) * s[1],
            0,
            2 * (x * z + y * w) * s[2],
            2 * (y * z - x * w) * s[2],
            (1 - 2 * (x * x + y * y)) * s[2],
            0,
            t[0],
            t[1],
            t[2],
            1};
}

/// Elements of an accessor: bytes from `data` on, `stride` apart.
struct View {
    std::string_view data;
    std::size_t stride, count;
    int component;
};

class GlbParser {
public:
    GlbParser(std::string_view bytes, const std::string& file)
        : file_(file), chunks_(split(bytes, file)), budget_(kMaxInstances * bytes.size()) {}

    Mesh parse() {
        document_ = Json::parse(chunks_.json);
        if (const auto needed = document_.find("extensionsRequired"); needed != document_.end() && !needed->empty()) {
            fail_unsupported(file_, "needs the extension " + in_quotes((*needed)[0].get<std::string>()));
        }
        visit_scene();
        if (!every_node_has_id_) mesh_.object.clear();
        check_mesh(mesh_, file_);
        return std::move(mesh_);
    }

private:
    const Json& item(const char* list, std::size_t index) {
        const auto found = document_.find(list);
        if (found == document_.end() || !found->is_array() || index >= found->size()) {
            fail_glb(file_, "refers to " + std::string(list) + "[" + std::to_string(index) + "], which does not exist");
        }
        return (*found)[index];
    }
    /// A count or offset: a number that is not negative.
    std::size_t size_at(const Json& object, const char* key, std::optional<std::size_t> otherwise) {
        const auto found = object.find(key);
        if (found == object.end() && otherwise) return *otherwise;
        if (found == object.end() || !found->is_number_unsigned()) fail_glb(file_, "a number is missing or wrong", key);
        return found->get<std::size_t>();
    }

    void visit_scene() {
        struct Visit {
            std::size_t node;
            Matrix transform;
        };
        std::vector<Visit> stack;
        for (const std::size_t root : roots()) stack.push_back({root, kIdentity});
        std::vector<bool> seen;
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            const Json& node = item("nodes", visit.node);
            seen.resize(document_["nodes"].size());
            if (seen[visit.node]) fail_glb(file_, "a node has two parents", "nodes[" + std::to_string(visit.node) + "]");
            seen[visit.node] = true;
            const bool is_frame = is_volume_frame(node);
            const Matrix transform = is_frame ? visit.transform : product(visit.transform, local_transform(node));
            if (node.contains("mesh")) add_mesh(node, transform);
            const auto children = node.find("children");
            if (children == node.end()) continue;
            for (auto child = children->rbegin(); child != children->rend(); ++child)
                stack.push_back({child->get<std::size_t>(), transform});
        }
    }
    /// Whether the node turns the space of a volume into that of glTF, as write_surface() makes it: then the points below it are read as
    /// they were in the volume. A node that was moved since is a transform like any other.
    bool is_volume_frame(const Json& node) {
        const auto extras = node.find("extras");
        if (extras == node.end() || !extras->is_object() || extras->value("frame", Json()) != kVolumeFrame) return false;
        const Json space = extras->value("space", Json()), unit = extras->value("unit", Json());
        if (!space.is_string() || !(unit.is_string() || unit.is_null())) return false;
        const std::string unit_name = unit.is_string() ? unit.get<std::string>() : "";
        if (!is_same_matrix(local_transform(node), gltf_frame(space.get<std::string>(), unit_name))) return false;
        mesh_.space = printable(space.get<std::string>());
        mesh_.unit = printable(unit_name);
        return true;
    }
    /// Last root first: the stack reverses the order.
    std::vector<std::size_t> roots() {
        std::vector<std::size_t> nodes;
        if (document_.contains("scenes")) {
            const Json& scene = item("scenes", size_at(document_, "scene", 0));
            if (const auto listed = scene.find("nodes"); listed != scene.end()) nodes = listed->get<std::vector<std::size_t>>();
        } else if (document_.contains("nodes")) {
            nodes = nodes_without_parent();
        }
        return {nodes.rbegin(), nodes.rend()};
    }
    std::vector<std::size_t> nodes_without_parent() {
        const Json& all = document_["nodes"];
        std::vector<bool> is_child(all.size());
        for (const Json& node : all) {
            const auto children = node.find("children");
            if (children == node.end()) continue;
            for (const Json& child : *children) {
                const auto index = child.get<std::size_t>();
                if (index < is_child.size()) is_child[index] = true;
            }
        }
        std::vector<std::size_t> nodes;
        for (std::size_t i = 0; i < is_child.size(); ++i) {
            if (!is_child[i]) nodes.push_back(i);
        }
        return nodes;
    }

    void add_mesh(const Json& node, const Matrix& transform) {
        const std::size_t points_before = mesh_.points.size(), triangles_before = mesh_.triangles.size();
        std::map<std::size_t, std::size_t> first_point;  ///< accessor -> its points, shared by the primitives of a mesh
        for (const Json& primitive : item("meshes", size_at(node, "mesh", {})).at("primitives"))
            add_primitive(primitive, transform, first_point);
        if (determinant(transform) < 0) {  // a mirror reverses the orientation
            for (std::size_t t = triangles_before; t < mesh_.triangles.size(); ++t) std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
        }
        const auto extras = node.find("extras");
        const bool has_id =
            extras != node.end() && extras->is_object() && extras->contains("object") && (*extras)["object"].is_number_integer();
        if (has_id) mesh_.object.resize(mesh_.points.size(), (*extras)["object"].get<std::int64_t>());
        if (!has_id && mesh_.points.size() > points_before) every_node_has_id_ = false;
    }
    void add_primitive(const Json& primitive, const Matrix& transform, std::map<std::size_t, std::size_t>& first_point) {
        const std::size_t mode = size_at(primitive, "mode", 4);
        if (mode < 4) return;  // points and lines
        const std::size_t accessor = size_at(primitive.at("attributes"), "POSITION", {});
        const View positions = view_of(accessor, "VEC3");
        const auto [entry, is_new] = first_point.try_emplace(accessor, mesh_.points.size());
        if (is_new) add_points(positions, transform);
        const std::vector<std::int64_t> corners = corners_of(primitive, positions.count, entry->second);
        if (mode == 5) {
            add_strip(mesh_, corners);
        } else if (mode == 6) {
            add_polygon(mesh_, corners);
        } else {
            for (std::size_t i = 2; i < corners.size(); i += 3) mesh_.triangles.push_back({corners[i - 2], corners[i - 1], corners[i]});
        }
    }
    void add_points(const View& positions, const Matrix& transform) {
        if (positions.component != 5126) fail_unsupported(file_, "positions are not float32");
        ByteCursor in(positions.data, file_);
        for (std::size_t i = 0; i < positions.count; ++i) {
            in.go_to(i * positions.stride);
            std::array<double, 3> point{};
            for (double& x : point) x = static_cast<double>(in.number<float>(false, "a position"));
            mesh_.points.push_back(transformed(transform, point));
        }
    }
    std::vector<std::int64_t> corners_of(const Json& primitive, std::size_t points, std::size_t first) {
        std::vector<std::int64_t> corners;
        if (!primitive.contains("indices")) {
            for (std::size_t i = 0; i < points; ++i) corners.push_back(static_cast<std::int64_t>(first + i));
            return corners;
        }
        const View view = view_of(size_at(primitive, "indices", {}), "SCALAR");
        ByteCursor in(view.data, file_);
        corners.reserve(view.count);
        for (std::size_t i = 0; i < view.count; ++i) {
            in.go_to(i * view.stride);
            std::size_t index = 0;
            if (view.component == 5121) index = in.number<std::uint8_t>(false, "an index");
            if (view.component == 5123) index = in.number<std::uint16_t>(false, "an index");
            if (view.component == 5125) index = in.number<std::uint32_t>(false, "an index");
            if (index >= points) fail_glb(file_, "a triangle names point " + std::to_string(index) + " of " + std::to_string(points));
            corners.push_back(static_cast<std::int64_t>(first + index));
        }
        return corners;
    }
    View view_of(std::size_t index, const char* type) {
        const Json& accessor = item("accessors", index);
        const std::string where = "accessors[" + std::to_string(index) + "]";
        if (accessor.contains("sparse") || !accessor.contains("bufferView")) fail_unsupported(file_, where + " is sparse");
        if (accessor.at("type").get<std::string>() != type) fail_glb(file_, "is not of type " + std::string(type), where);
        const Json& view = item("bufferViews", size_at(accessor, "bufferView", {}));
        if (item("buffers", size_at(view, "buffer", {})).contains("uri")) fail_unsupported(file_, "external data files are not supported");
        const std::size_t begin = size_at(view, "byteOffset", 0), length = size_at(view, "byteLength", {});
        if (begin > chunks_.binary.size() || length > chunks_.binary.size() - begin)
            fail_glb(file_, "its data lie outside the file", where);
        const int component = accessor.at("componentType").get<int>();
        const std::size_t bytes = component_bytes(component, where) * (std::string_view(type) == "VEC3" ? 3 : 1);
        const std::size_t stride = size_at(view, "byteStride", bytes), count = size_at(accessor, "count", {});
        const std::size_t offset = size_at(accessor, "byteOffset", 0);
        if (stride < bytes) fail_glb(file_, "its elements overlap", where);
        const bool fits = count == 0 || (offset <= length && bytes <= length - offset && count - 1 <= (length - offset - bytes) / stride);
        if (!fits) fail_glb(file_, "claims " + std::to_string(count) + " elements, more than its data holds", where);
        if (count > budget_) fail_unsupported(file_, "its nodes repeat the same mesh too often");
        budget_ -= count;
        return {count == 0 ? std::string_view() : chunks_.binary.substr(begin + offset, length - offset), stride, count, component};
    }
    std::size_t component_bytes(int component, const std::string& where) {
        switch (component) {
            case 5121: return 1;
            case 5123: return 2;
            case 5125:
            case 5126: return 4;
            default: fail_glb(file_, "has the component type " + std::to_string(component), where);
        }
    }

    const std::string& file_;
    Chunks chunks_;
    std::size_t budget_;  ///< elements that may still be read
    Json document_;
    Mesh mesh_;
    bool every_node_has_id_ = true;
};

}  // namespace

Mesh parse_glb(std::string_view bytes, const std::string& file) {
    GlbParser parser(bytes, file);
    try {
        return parser.parse();
    } catch (const Json::exception& error) {
        fail_glb(file, std::string("the JSON of the file is damaged: ") + error.what());
    }
}

}  // namespace isoatlas
