// Small surfaces for the tests of mesh files, and comparison of meshes up to the numbering of points.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "isoatlas/surface.h"

namespace mesh_samples {

using isoatlas::Mesh;
using isoatlas::Surface;
using Point = std::array<double, 3>;

/// A folder of its own that goes away with the test.
class Folder {
public:
    Folder() : path_(std::filesystem::temp_directory_path() / ("isoatlas_mesh_" + std::to_string(::getpid()))) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    [[nodiscard]] std::size_t files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
    }

private:
    std::filesystem::path path_;
};

inline std::string read_bytes(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Adds an octahedron around `centre`; inside out for the wall of a cavity.
inline void add_octahedron(Surface& surface, const Point& centre, double radius, std::int64_t object, std::int64_t contour,
                           bool inside_out = false) {
    const auto first = static_cast<std::int64_t>(surface.points.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {1.0F, -1.0F}) {
            Point p = centre;
            p[static_cast<std::size_t>(axis)] += static_cast<double>(sign) * radius;
            std::array<float, 3> normal{0, 0, 0};
            normal[static_cast<std::size_t>(axis)] = inside_out ? -sign : sign;
            surface.points.push_back(p);
            surface.normals.push_back(normal);
            surface.object.push_back(object);
            surface.contour.push_back(contour);
        }
    }
    for (int corner = 0; corner < 8; ++corner) {
        std::array<std::int64_t, 3> t{first + (corner & 1), first + 2 + (corner >> 1 & 1), first + 4 + (corner >> 2 & 1)};
        const bool odd = ((corner & 1) + (corner >> 1 & 1) + (corner >> 2 & 1)) % 2 == 1;
        if (odd != inside_out) std::swap(t[1], t[2]);
        surface.triangles.push_back(t);
    }
}

/// Two objects, one of them with a cavity and a number that needs 64 bits.
inline Surface two_objects() {
    Surface surface;
    add_octahedron(surface, {10.25, 20.5, 30}, 4, 5'000'000'000, 5'000'000'000);
    add_octahedron(surface, {-3, 0.1, 7}, 1.5, 7, 7);
    add_octahedron(surface, {10.25, 20.5, 30}, 1, 5'000'000'000, 12, true);
    surface.tau = 100;
    surface.reported_tau = 100.5;
    surface.space = "LPS";
    surface.unit = "mm";
    return surface;
}

/// Coordinates that float32 cannot tell apart.
inline Surface far_away() {
    Surface surface;
    add_octahedron(surface, {1e6, -2e6, 3e6}, 1e-3, 3, 3);
    surface.reported_tau = -1;
    return surface;
}

/// A closed curve of a 2D image.
inline Surface curve() {
    Surface surface;
    surface.points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
    surface.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    surface.object.assign(4, 9);
    surface.contour.assign(4, 9);
    return surface;
}

/// A triangle by value: its corners and their ids.
struct Corner {
    Point point;
    std::int64_t object, contour;
    auto operator<=>(const Corner&) const = default;
};
using Triangle = std::array<Corner, 3>;

inline std::vector<Triangle> sorted_triangles(const isoatlas::Array<Point>& points,
                                              const isoatlas::Array<std::array<std::int64_t, 3>>& triangles,
                                              const isoatlas::Array<std::int64_t>& object, const isoatlas::Array<std::int64_t>& contour) {
    std::vector<Triangle> result;
    for (const auto& t : triangles) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto p = static_cast<std::size_t>(t[k]);
            triangle[k] = {points[p], object.empty() ? -1 : object[p], contour.empty() ? -1 : contour[p]};
        }
        result.push_back(triangle);
    }
    std::sort(result.begin(), result.end());
    return result;
}

inline isoatlas::Array<Point> in_float32(isoatlas::Array<Point> points) {
    for (Point& p : points) {
        for (double& x : p) x = static_cast<double>(static_cast<float>(x));
    }
    return points;
}

}  // namespace mesh_samples
