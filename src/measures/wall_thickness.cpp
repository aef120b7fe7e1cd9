#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "base/cancel.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/streamed.h"
#include "isoatlas/environment.h"
#include "isoatlas/thickness.h"
#include "measures/object_walls.h"
#include "measures/solid_rays.h"
#include "measures/vectors.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kPointsTogether = 4096;  // points
constexpr int kAround = 6;
constexpr double kTilt = 15 * std::numbers::pi / 180;  // of the rays around the normal
constexpr double kOpposite = std::numbers::sqrt2 / 2;  // a ray leaves within 45 degrees of the normal there
constexpr std::int64_t kBytesPerTriangle = 200;        // of Embree's tree, with the buffers
constexpr float kNoWall = std::numeric_limits<float>::infinity();

void check(const Surface& surface) {
    if (!surface.segments.empty() || !surface.closed)
        throw Error(ErrorKind::usage, {.where = "the surface", .what = "has no inside", .expected = "closed triangles"});
    if (surface.points.size() >= std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorKind::unsupported, {.what = "a surface of more than 2^32 points"});
    const std::int64_t bytes = kBytesPerTriangle * static_cast<std::int64_t>(surface.triangles.size()), limit = memory_limit();
    if (limit > 0 && bytes > limit) {
        throw Error(ErrorKind::resource, {.what = "the thickness of the walls needs " + std::to_string(bytes) + " bytes of memory",
                                          .expected = "at most " + std::to_string(limit)});
    }
}

Vec3 area_normal(const Surface& surface, const std::array<std::int64_t, 3>& corners) {
    const auto at = [&](std::size_t c) -> const Vec3& { return surface.points[static_cast<std::size_t>(corners[c])]; };
    return times(0.5, cross(minus(at(1), at(0)), minus(at(2), at(0))));
}

/// Of the points, of no particular length: sums over their triangles, weighted by area.
Array<std::array<float, 3>> outward_normals(const Surface& surface) {
    Array<std::array<float, 3>> normals(surface.points.size());
    std::ranges::fill(normals, std::array<float, 3>{});
    for (const std::size_t i : streamed(surface.triangles.size(), at_random())) {
        const Vec3 normal = area_normal(surface, surface.triangles[i]);
        for (const std::int64_t corner : surface.triangles[i]) {
            for (std::size_t k = 0; k < 3; ++k) normals[static_cast<std::size_t>(corner)][k] += static_cast<float>(normal[k]);
        }
    }
    return normals;
}

/// Inwards along the normal, and a ring of directions around it.
std::array<Vec3, 1 + kAround> directions(const Vec3& inwards) {
    std::array<Vec3, 1 + kAround> result;
    result[0] = inwards;
    std::size_t least = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        if (std::abs(inwards[k]) < std::abs(inwards[least])) least = k;
    }
    Vec3 axis{};
    axis[least] = 1;
    const Vec3 u = unit(cross(inwards, axis)), v = cross(inwards, u);
    for (std::size_t i = 0; i < kAround; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kAround;
        const Vec3 aside = plus(times(std::cos(angle), u), times(std::sin(angle), v));
        result[1 + i] = plus(times(std::cos(kTilt), inwards), times(std::sin(kTilt), aside));
    }
    return result;
}

/// The diameter of the smallest ball that touches the surface at the point from inside, and where one of the rays leaves.
float thickness_at(const SolidRays& rays, std::size_t point, const Vec3& outwards) {
    const std::array<Vec3, 1 + kAround> all = directions(times(-1, outwards));
    double least = kNoWall;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::optional<SolidRays::Exit> exit = rays.way_out(point, all[i]);
        if (exit && exit->facing >= kOpposite) least = std::min(least, exit->length / (i == 0 ? 1 : std::cos(kTilt)));
    }
    return static_cast<float>(least);
}

struct Wall {
    float thickness, area;
};

/// A triangle belongs to a wall if all of its corners do; the thickest of them counts, so that none is thin by a single point at an edge.
Wall wall_at(const Surface& surface, const std::array<std::int64_t, 3>& corners, const Array<float>& thickness) {
    float largest = 0;
    for (const std::int64_t corner : corners) largest = std::max(largest, thickness[static_cast<std::size_t>(corner)]);
    return {largest, static_cast<float>(norm(area_normal(surface, corners)))};
}

WallThickness summary(std::vector<Wall> walls, double limit) {
    WallThickness result;
    result.triangles = std::ssize(walls);
    if (walls.empty()) return result;
    std::ranges::sort(walls, {}, [](const Wall& wall) { return std::pair(wall.thickness, wall.area); });
    for (const Wall& wall : walls) {
        result.area += wall.area;
        if (wall.thickness < limit) result.thin_area += wall.area;
    }
    double below = 0;
    const auto half = std::ranges::find_if(walls, [&](const Wall& wall) { return (below += wall.area) >= result.area / 2; });
    result.min = walls.front().thickness;
    result.median = half == walls.end() ? walls.back().thickness : half->thickness;
    return result;
}

/// Thickness behind every point; kNoWall: none.
Array<float> thickness_of_points(const Surface& surface, const Context& context) {
    const Array<std::array<float, 3>> normals = outward_normals(surface);
    const SolidRays rays(surface, context);
    const std::int64_t points = std::ssize(surface.points);
    Array<float> thickness(surface.points.size());
    const CallerLooks look(context);
    for_each_block(context.threads, (points + kPointsTogether - 1) / kPointsTogether, [&](std::int64_t block) {
        look();
        for (std::int64_t i = block * kPointsTogether; i < std::min(points, (block + 1) * kPointsTogether); ++i) {
            const auto point = static_cast<std::size_t>(i);
            const Vec3 outwards{normals[point][0], normals[point][1], normals[point][2]};
            thickness[point] = norm(outwards) > 0 ? thickness_at(rays, point, unit(outwards)) : kNoWall;
        }
    });
    return thickness;
}

/// Of each of some parts of the surface; part_of: that of a point.
template <class PartOf>
std::vector<std::vector<Wall>> walls_of_parts(const Surface& surface, std::size_t parts, const PartOf& part_of, const Context& context) {
    check(surface);
    std::vector<std::vector<Wall>> walls(parts);
    if (surface.triangles.empty()) return walls;
    const Array<float> thickness = thickness_of_points(surface, context);
    for (const std::size_t i : streamed(surface.triangles.size(), at_random())) {
        const Wall wall = wall_at(surface, surface.triangles[i], thickness);
        if (wall.thickness != kNoWall) walls[part_of(static_cast<std::size_t>(surface.triangles[i][0]))].push_back(wall);
    }
    return walls;
}

}  // namespace

WallThickness wall_thickness(const Surface& surface, const WallOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    return summary(walls_of_parts(surface, 1, [](std::size_t) { return std::size_t{0}; }, context)[0], options.limit);
}

void measure_walls(const Surface& surface, std::span<ObjectMeasures> objects, const Context& context) {
    std::unordered_map<std::int64_t, std::size_t> position;
    for (std::size_t i = 0; i < objects.size(); ++i) position.emplace(objects[i].id, i);
    const auto part_of = [&](std::size_t point) { return position.at(surface.object[point]); };
    std::vector<std::vector<Wall>> walls = walls_of_parts(surface, objects.size(), part_of, context);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        if (walls[i].empty()) continue;
        const WallThickness thickness = summary(std::move(walls[i]), 0);
        objects[i].thickness = {thickness.min, thickness.median};
    }
}

}  // namespace isoatlas
