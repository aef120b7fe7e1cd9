#include "compare/shapes.h"

#include <cmath>

namespace isoatlas::cli {
namespace {

Vec3 along(const Vec3& from, double length, const Vec3& direction) {
    return {from[0] + length * direction[0], from[1] + length * direction[1], from[2] + length * direction[2]};
}
Vec3 difference(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec3 cross(const Vec3& a, const Vec3& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }
double length(const Vec3& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

/// Of length 1; of a zero vector x.
Vec3 unit(const Vec3& a) {
    const double size = length(a);
    return size > 0 ? Vec3{a[0] / size, a[1] / size, a[2] / size} : Vec3{1, 0, 0};
}

/// Two unit vectors perpendicular to a unit vector and to each other.
std::array<Vec3, 2> across(const Vec3& axis) {
    const Vec3 other = std::abs(axis[0]) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 first = unit(cross(axis, other));
    return {first, cross(axis, first)};
}

}  // namespace

void Shapes::add_rod(const Vec3& from, const Vec3& to, double radius) {
    constexpr std::int64_t kSides = 6;
    constexpr double kTurn = 6.283185307179586 / kSides;
    const Vec3 axis = unit(difference(to, from));
    const auto [right, up] = across(axis);
    const std::int64_t first = std::ssize(surface_.points);
    for (std::int64_t i = 0; i < kSides; ++i) {
        const double angle = kTurn * static_cast<double>(i);
        const Vec3 offset = along(along({0, 0, 0}, radius * std::cos(angle), right), radius * std::sin(angle), up);
        surface_.points.push_back(along(from, 1, offset));
        surface_.points.push_back(along(to, 1, offset));
    }
    const std::int64_t tip = first + 2 * kSides;
    surface_.points.push_back(along(from, -radius, axis));
    surface_.points.push_back(along(to, radius, axis));
    for (std::int64_t i = 0; i < kSides; ++i) {
        const std::int64_t here = first + 2 * i, next = first + 2 * ((i + 1) % kSides);
        surface_.triangles.push_back({here, next, here + 1});
        surface_.triangles.push_back({next, next + 1, here + 1});
        surface_.triangles.push_back({tip, next, here});
        surface_.triangles.push_back({tip + 1, here + 1, next + 1});
    }
}

void Shapes::add_ball(const Vec3& middle, double radius) {
    const std::int64_t first = std::ssize(surface_.points);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double side : {radius, -radius}) {
            Vec3 point = middle;
            point[axis] += side;
            surface_.points.push_back(point);
        }
    }
    for (int octant = 0; octant < 8; ++octant) {
        const std::int64_t x = first + (octant & 1), y = first + 2 + (octant >> 1 & 1), z = first + 4 + (octant >> 2);
        const bool is_mirrored = ((octant & 1) ^ (octant >> 1 & 1) ^ (octant >> 2)) != 0;
        surface_.triangles.push_back(is_mirrored ? std::array{x, z, y} : std::array{x, y, z});
    }
}

void Shapes::add_tile(const Vec3& middle, const Vec3& normal, const Vec3& sides) {
    const auto [right, up] = across(normal);
    const auto half = [&sides](const Vec3& direction) {
        return length({direction[0] * sides[0], direction[1] * sides[1], direction[2] * sides[2]}) / 2;
    };
    const double half_width = half(right), half_height = half(up);
    const std::int64_t first = std::ssize(surface_.points);
    for (const auto& [x, y] : {std::array{-1, -1}, std::array{1, -1}, std::array{1, 1}, std::array{-1, 1}}) {
        surface_.points.push_back(along(along(middle, x * half_width, right), y * half_height, up));
        surface_.normals.push_back({static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])});
    }
    surface_.triangles.push_back({first, first + 1, first + 2});
    surface_.triangles.push_back({first, first + 2, first + 3});
}

SplitSurface split(const Surface& surface, const std::vector<std::int64_t>& part) {
    SplitSurface both;
    for (Surface* one : {&both.rest, &both.part}) one->unit = surface.unit, one->space = surface.space, one->tau = surface.tau;
    std::array<std::vector<std::int64_t>, 2> number;
    for (auto& list : number) list.assign(surface.points.size(), -1);
    auto next = part.begin();
    for (std::int64_t i = 0; i < std::ssize(surface.triangles); ++i) {
        const bool is_part = next != part.end() && *next == i;
        if (is_part) ++next;
        Surface& into = is_part ? both.part : both.rest;
        std::array<std::int64_t, 3> triangle = surface.triangles[i];
        for (std::int64_t& point : triangle) {
            std::int64_t& known = number[is_part ? 1 : 0][static_cast<std::size_t>(point)];
            if (known < 0) {
                known = std::ssize(into.points);
                into.points.push_back(surface.points[point]);
                if (!surface.normals.empty()) into.normals.push_back(surface.normals[point]);
            }
            point = known;
        }
        into.triangles.push_back(triangle);
    }
    return both;
}

void add_normals(Surface& surface) {
    std::vector<Vec3> sum(surface.points.size(), Vec3{0, 0, 0});
    for (const auto& triangle : surface.triangles) {
        const Vec3& corner = surface.points[triangle[0]];
        const Vec3 twice_area = cross(difference(surface.points[triangle[1]], corner), difference(surface.points[triangle[2]], corner));
        for (const std::int64_t point : triangle)
            sum[static_cast<std::size_t>(point)] = along(sum[static_cast<std::size_t>(point)], 1, twice_area);
    }
    surface.normals.clear();
    for (const Vec3& normal : sum) {
        const Vec3 one = unit(normal);
        surface.normals.push_back({static_cast<float>(one[0]), static_cast<float>(one[1]), static_cast<float>(one[2])});
    }
}

}  // namespace isoatlas::cli
