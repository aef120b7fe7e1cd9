// Checks and helpers of all mesh formats: consistent arrays, indices in range, groups of one object, comments.
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "formats/common/text.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

template <std::size_t N>
void check_indices(const Array<std::array<std::int64_t, N>>& cells, std::int64_t points, const char* name, const std::string& file) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (const std::int64_t p : cells[i]) {
            if (p >= 0 && p < points) continue;
            throw Error(ErrorKind::usage, {.file = file,
                                           .where = std::string(name) + " " + std::to_string(i),
                                           .what = "names point " + std::to_string(p) + ", which the surface does not have",
                                           .expected = "0.." + std::to_string(points - 1),
                                           .next = "pass a surface as extract returns it"});
        }
    }
}

void check_length(std::size_t length, std::size_t points, const char* name, const std::string& file) {
    if (length == 0 || length == points) return;
    throw Error(ErrorKind::usage,
                {.file = file,
                 .what = "the surface has " + std::to_string(length) + " " + name + " for " + std::to_string(points) + " points",
                 .expected = "none, or one for each point",
                 .next = "pass a surface as extract returns it"});
}

}  // namespace

void check_surface(const Surface& surface, const std::string& file) {
    const std::size_t points = surface.points.size();
    check_length(surface.normals.size(), points, "normals", file);
    check_length(surface.object.size(), points, "object ids", file);
    check_length(surface.contour.size(), points, "contour ids", file);
    check_indices(surface.triangles, static_cast<std::int64_t>(points), "triangle", file);
    check_indices(surface.segments, static_cast<std::int64_t>(points), "segment", file);
}

void check_mesh(const Mesh& mesh, const std::string& file) {
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const auto& p = mesh.points[i];
        if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
        throw Error(ErrorKind::input, {.file = file,
                                       .where = "point " + std::to_string(i),
                                       .what = "a coordinate is not a finite number",
                                       .next = "repair the mesh with the program that made it"});
    }
    const auto points = static_cast<std::int64_t>(mesh.points.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (const std::int64_t p : mesh.triangles[i]) {
            if (p >= 0 && p < points) continue;
            throw Error(ErrorKind::input,
                        {.file = file,
                         .where = "triangle " + std::to_string(i),
                         .what = "names point " + std::to_string(p) + ", which the file does not have",
                         .expected = points > 0 ? "0.." + std::to_string(points - 1) : "no triangles: there are no points",
                         .next = "repair the mesh with the program that made it"});
        }
    }
}

void add_polygon(Mesh& mesh, const std::vector<std::int64_t>& corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

void add_strip(Mesh& mesh, const std::vector<std::int64_t>& corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const std::size_t odd = i % 2;
        mesh.triangles.push_back({corners[i - 2 + odd], corners[i - 1 - odd], corners[i]});
    }
}

void take_comment(Mesh& mesh, std::string_view text) {
    constexpr std::string_view kSlicer = "SPACE=";
    const std::vector<std::string_view> words = split_words(text);
    for (const std::string_view word : words) {
        if (word.starts_with(kSlicer)) mesh.space = printable(word.substr(kSlicer.size()));
    }
    if (words.size() != 2) return;
    if (words[0] == "space") mesh.space = printable(words[1]);
    if (words[0] == "unit") mesh.unit = printable(words[1]);
}

ObjectGroups one_group(const Surface& surface) {
    const std::size_t count = surface.segments.empty() ? surface.triangles.size() : surface.segments.size();
    ObjectGroups result;
    result.order.resize(count);
    for (std::size_t i = 0; i < count; ++i) result.order[i] = static_cast<std::int64_t>(i);
    if (count > 0) result.groups.push_back({0, 0, static_cast<std::int64_t>(count)});
    return result;
}

ObjectGroups group_by_object(const Surface& surface) {
    const bool curves = !surface.segments.empty();
    const std::size_t count = curves ? surface.segments.size() : surface.triangles.size();
    const auto first_point = [&](std::size_t i) { return curves ? surface.segments[i][0] : surface.triangles[i][0]; };
    ObjectGroups result;
    result.order.resize(count);
    result.has_ids = !surface.object.empty();
    if (!result.has_ids) return one_group(surface);
    std::unordered_map<std::int64_t, std::int64_t> counts;
    for (std::size_t i = 0; i < count; ++i) ++counts[surface.object[first_point(i)]];
    for (const auto& [object, size] : counts) result.groups.push_back({object, 0, size});
    std::sort(result.groups.begin(), result.groups.end(), [](const auto& p, const auto& q) { return p.object < q.object; });
    std::int64_t first = 0;
    for (ObjectGroups::Group& group : result.groups) {
        group.first = first;
        counts[group.object] = first;  // from here on: position of the next one
        first += group.count;
    }
    for (std::size_t i = 0; i < count; ++i) result.order[counts[surface.object[first_point(i)]]++] = static_cast<std::int64_t>(i);
    return result;
}

bool has_inner_contours(const MeshParts& parts) {
    for (const MeshPart& part : parts.parts) {
        const Surface& surface = part.surface();
        if (surface.contour.empty() || surface.object.empty()) continue;
        std::unordered_map<std::int64_t, std::int64_t> contour_of;
        for (std::size_t i = 0; i < surface.object.size(); ++i) {
            if (contour_of.try_emplace(surface.object[i], surface.contour[i]).first->second != surface.contour[i]) return true;
        }
    }
    return false;
}

}  // namespace isoatlas
