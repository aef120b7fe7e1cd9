// Directions and matrices of three numbers, beside what geometry/vectors.h has.
#pragma once

#include <cmath>

#include "geometry/vectors.h"
#include "isoatlas/volume.h"

namespace isoatlas {

[[nodiscard]] inline Vec3 times(double factor, const Vec3& p) { return {factor * p[0], factor * p[1], factor * p[2]}; }
[[nodiscard]] inline Vec3 unit(const Vec3& p) { return times(1 / norm(p), p); }
[[nodiscard]] inline Vec3 times(const Mat3& m, const Vec3& p) { return {dot(m[0], p), dot(m[1], p), dot(m[2], p)}; }
[[nodiscard]] inline Mat3 transposed(const Mat3& m) {
    return {{{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}}};
}

/// A direction or its opposite: that whose largest component is positive. No component is -0.
[[nodiscard]] inline Vec3 pointed(const Vec3& axis) {
    std::size_t largest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        if (std::abs(axis[k]) > std::abs(axis[largest]) * (1 + 1e-12)) largest = k;
    }
    return plus(axis[largest] < 0 ? times(-1, axis) : axis, {0, 0, 0});
}

}  // namespace isoatlas
