// Surfaces whose pictures are known.
#pragma once

#include <cmath>
#include <numbers>

#include "isoatlas/render.h"

namespace isoatlas::test {

inline Surface ball(const Vec3& centre, double radius, double tau, int bands = 128) {
    Surface surface;
    surface.tau = tau;
    surface.unit = "mm";
    const auto put = [&](double theta, double phi) {
        const Vec3 n{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
        surface.points.push_back({centre[0] + radius * n[0], centre[1] + radius * n[1], centre[2] + radius * n[2]});
        surface.normals.push_back({static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
        return static_cast<std::int64_t>(surface.points.size()) - 1;
    };
    for (int i = 0; i <= bands; ++i) {
        for (int j = 0; j < 2 * bands; ++j) put(std::numbers::pi * i / bands, std::numbers::pi * j / bands);
    }
    const std::int64_t around = 2 * bands;
    for (std::int64_t i = 0; i < bands; ++i) {
        for (std::int64_t j = 0; j < around; ++j) {
            const std::int64_t a = i * around + j, b = i * around + (j + 1) % around, c = a + around, d = b + around;
            if (i + 1 < bands) surface.triangles.push_back({a, c, d});
            if (i > 0) surface.triangles.push_back({a, d, b});
        }
    }
    return surface;
}

/// Faces outwards, no normals.
inline Surface box(const Vec3& low, const Vec3& high, double tau) {
    Surface surface;
    surface.tau = tau;
    for (int i = 0; i < 8; ++i)
        surface.points.push_back({(i & 1) != 0 ? high[0] : low[0], (i & 2) != 0 ? high[1] : low[1], (i & 4) != 0 ? high[2] : low[2]});
    const std::int64_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
        surface.triangles.push_back({f[0], f[1], f[2]});
        surface.triangles.push_back({f[0], f[2], f[3]});
    }
    return surface;
}

}  // namespace isoatlas::test
