// The quadric of a point (Garland and Heckbert, Surface simplification using quadric error metrics, 1997): the sum of squared distances to
// the planes of triangles, each times the triangle's area. Coordinates are relative to the point, so that single precision is enough.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/vectors.h"

namespace isoatlas {

/// x -> x A x + 2 b x + c, with A symmetric: xx, yy, zz, xy, xz, yz.
template <class Real>
struct Quadric {
    std::array<Real, 6> a{};
    std::array<Real, 3> b{};
    Real c = 0;

    /// Of a plane through the origin: a triangle with two sides from there.
    void add_triangle(const Vec3& side, const Vec3& other) {
        const Vec3 n = cross(side, other);
        const double twice_area = std::sqrt(dot(n, n));
        if (!(twice_area > 0)) return;
        const double weight = 1 / (2 * twice_area);
        const std::array<double, 6> products{n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[0] * n[2], n[1] * n[2]};
        for (std::size_t i = 0; i < 6; ++i) a[i] += static_cast<Real>(weight * products[i]);
    }
    [[nodiscard]] double area() const { return static_cast<double>(a[0]) + static_cast<double>(a[1]) + static_cast<double>(a[2]); }
};

inline Vec3 times(const std::array<double, 6>& a, const Vec3& x) {
    return {a[0] * x[0] + a[3] * x[1] + a[4] * x[2], a[3] * x[0] + a[1] * x[1] + a[5] * x[2], a[4] * x[0] + a[5] * x[1] + a[2] * x[2]};
}

[[nodiscard]] inline double error_at(const Quadric<double>& q, const Vec3& x) {
    return dot(x, times(q.a, x)) + 2 * dot(Vec3{q.b[0], q.b[1], q.b[2]}, x) + q.c;
}

/// Adds the quadric of a point that lies at `from`, seen from the origin.
inline void add_quadric(Quadric<double>& sum, const Quadric<float>& q, const Vec3& from) {
    std::array<double, 6> a{};
    for (std::size_t i = 0; i < 6; ++i) a[i] = q.a[i];
    const Vec3 back{-from[0], -from[1], -from[2]}, of_back = times(a, back), b{q.b[0], q.b[1], q.b[2]};
    for (std::size_t i = 0; i < 6; ++i) sum.a[i] += a[i];
    for (std::size_t i = 0; i < 3; ++i) sum.b[i] += b[i] + of_back[i];
    sum.c += q.c + 2 * dot(b, back) + dot(back, of_back);
}

[[nodiscard]] inline Quadric<float> rounded(const Quadric<double>& q) {
    Quadric<float> result;
    for (std::size_t i = 0; i < 6; ++i) result.a[i] = static_cast<float>(q.a[i]);
    for (std::size_t i = 0; i < 3; ++i) result.b[i] = static_cast<float>(q.b[i]);
    result.c = static_cast<float>(q.c);
    return result;
}

/// Where the quadric is least, drawn to the origin a little so that it is unique: in a plane, the origin itself.
[[nodiscard]] inline Vec3 least_of(const Quadric<double>& q) {
    constexpr double kPull = 1e-3;
    const double pull = kPull * (q.a[0] + q.a[1] + q.a[2]) + 1e-300;
    const double xx = q.a[0] + pull, yy = q.a[1] + pull, zz = q.a[2] + pull, xy = q.a[3], xz = q.a[4], yz = q.a[5];
    const double cxx = yy * zz - yz * yz, cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy;
    const double cyy = xx * zz - xz * xz, cyz = xy * xz - xx * yz, czz = xx * yy - xy * xy;
    const double scale = -1 / (xx * cxx + xy * cxy + xz * cxz);
    return {scale * (cxx * q.b[0] + cxy * q.b[1] + cxz * q.b[2]), scale * (cxy * q.b[0] + cyy * q.b[1] + cyz * q.b[2]),
            scale * (cxz * q.b[0] + cyz * q.b[1] + czz * q.b[2])};
}

}  // namespace isoatlas
