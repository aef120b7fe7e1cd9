// Small meshes for tests.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "geometry/deviation.h"

namespace isoatlas {

struct TestMesh {
    std::vector<Vec3> points;
    std::vector<TriangleCorners> triangles;
    [[nodiscard]] MeshView view() const { return {points, triangles}; }

    void add(const std::array<Vec3, 3>& triangle) {
        const auto first = static_cast<std::int64_t>(points.size());
        points.insert(points.end(), triangle.begin(), triangle.end());
        triangles.push_back({first, first + 1, first + 2});
    }
};

/// Triangles without common points, of about this size, in a unit cube.
inline TestMesh soup(std::mt19937& random, int count, double size) {
    std::uniform_real_distribution<double> unit(0, 1), around(-size, size);
    TestMesh mesh;
    for (int i = 0; i < count; ++i) {
        const Vec3 centre{unit(random), unit(random), unit(random)};
        const auto point = [&] { return Vec3{centre[0] + around(random), centre[1] + around(random), centre[2] + around(random)}; };
        mesh.add({point(), point(), point()});
    }
    return mesh;
}

/// A height field over n x n squares of a unit square.
template <class Height>
TestMesh sheet(int n, const Height& height) {
    TestMesh mesh;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) {
            const double u = double(x) / n, v = double(y) / n;
            mesh.points.push_back({u, v, height(u, v)});
        }
    for (std::int64_t y = 0; y < n; ++y)
        for (std::int64_t x = 0; x < n; ++x) {
            const std::int64_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
    return mesh;
}

}  // namespace isoatlas
