// What pictures do with vectors, beside what geometry/vectors.h has.
#pragma once

#include <cmath>

#include "geometry/vectors.h"
#include "isoatlas/vec3.h"

namespace isoatlas {

inline Vec3 scale(const Vec3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
/// a + s b
inline Vec3 along(const Vec3& a, double s, const Vec3& b) { return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]}; }
inline Vec3 times(const Vec3& a, const Vec3& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }
/// The zero vector is unchanged.
inline Vec3 unit(const Vec3& a) {
    const double size = norm(a);
    return size > 0 ? scale(a, 1 / size) : a;
}
inline Vec3 mix(const Vec3& a, const Vec3& b, double t) { return along(scale(a, 1 - t), t, b); }

/// Two unit vectors that are perpendicular to the unit vector n and to each other (Duff et al., 2017).
inline void basis_of(const Vec3& n, Vec3& u, Vec3& v) {
    const double sign = std::copysign(1.0, n[2]), a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
    u = {1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]};
    v = {b, sign + n[1] * n[1] * a, -n[1]};
}

}  // namespace isoatlas
