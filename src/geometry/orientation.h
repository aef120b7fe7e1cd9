// On which side of a plane or line does a point lie? Exactly, for all finite coordinates: decided in doubles where their error allows it (a
// few nanoseconds), else in numbers of any length.
//
// In the literature: orient2d, orient3d (Shewchuk, Discrete Comput. Geom. 18, 1997).
#pragma once

#include <array>
#include <cmath>

#include "geometry/vectors.h"

namespace isoatlas {

using Vec2 = std::array<double, 2>;

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int exact_orientation(const Vec2& a, const Vec2& b, const Vec2& c);

inline constexpr int kUnsure = 2;

/// Of a rounded value with an error below `error`; kUnsure also where something is infinite.
inline int sign_or_unsure(double value, double error) { return value > error ? 1 : value < -error ? -1 : kUnsure; }

/// As orientation(a, b, c, d), or kUnsure. Of the same a, b, c in a row a compiler computes the parts once.
inline int quick_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = minus(b, a), v = minus(c, a), w = minus(d, a);
    const double x1 = u[1] * v[2], x2 = u[2] * v[1], y1 = u[2] * v[0], y2 = u[0] * v[2], z1 = u[0] * v[1], z2 = u[1] * v[0];
    const double value = (x1 - x2) * w[0] + (y1 - y2) * w[1] + (z1 - z2) * w[2];
    const double x = std::abs(w[0]), y = std::abs(w[1]), z = std::abs(w[2]);
    const double magnitude = (std::abs(x1) + std::abs(x2)) * x + (std::abs(y1) + std::abs(y2)) * y + (std::abs(z1) + std::abs(z2)) * z;
    constexpr double kRelative = 8 * 0x1p-53;  // Shewchuk: 7 + 56 * 2^-53
    constexpr double kUnderflow = 1e-300;      // more than what products below the least normal double lose
    return sign_or_unsure(value, kRelative * magnitude + kUnderflow * (x + y + z + 1));
}

inline int quick_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double p = (b[0] - a[0]) * (c[1] - a[1]), q = (b[1] - a[1]) * (c[0] - a[0]);
    return sign_or_unsure(p - q, 4 * 0x1p-53 * (std::abs(p) + std::abs(q)) + 1e-300);  // Shewchuk: 3 + 16 * 2^-53
}

/// The sign of (b - a) x (c - a) . (d - a): 1 where a, b, c run counter-clockwise seen from d, 0 where the four lie in a plane.
inline int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const int quick = quick_orientation(a, b, c, d);
    return quick == kUnsure ? exact_orientation(a, b, c, d) : quick;
}

/// In the plane: 1 where a, b, c run counter-clockwise, 0 where they lie on a line.
inline int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
    const int quick = quick_orientation(a, b, c);
    return quick == kUnsure ? exact_orientation(a, b, c) : quick;
}

}  // namespace isoatlas
