// The trilinear function of a cell as a polynomial: f = k0 + k1 x + k2 y + k3 z + k4 xy + k5 xz + k6 yz + k7 xyz.
// Theory: docs/theory/6-interior.md#finding-them.
#pragma once

#include <array>

namespace isoatlas {

/// k0..k7 from the corners, corner k = x + 2y + 4z. Any numbers.
template <class Number>
std::array<Number, 8> trilinear_coefficients(const std::array<Number, 8>& v) {
    return {v[0],
            v[1] - v[0],
            v[2] - v[0],
            v[4] - v[0],
            v[3] - v[1] - v[2] + v[0],
            v[5] - v[1] - v[4] + v[0],
            v[6] - v[2] - v[4] + v[0],
            v[7] - v[6] - v[5] - v[3] + v[4] + v[2] + v[1] - v[0]};
}

/// Where the gradient vanishes, up to rounding. abc: A = k1 k7 - k4 k5, B = k2 k7 - k4 k6, C = k3 k7 - k5 k6; q = sqrt(-ABC).
inline std::array<double, 3> saddle_position(const std::array<double, 8>& k, const std::array<double, 3>& abc, double q) {
    const auto [k0, k1, k2, k3, k4, k5, k6, k7] = k;
    // (root - k) / k7 without cancellation: the numerator is that of (root^2 - k^2) / k7, which divides by a.
    const auto coordinate = [last = k7](double a, double root, double of_axis, double numerator) {
        return root * of_axis <= 0 ? (root - of_axis) / last : -numerator / (a * (root + of_axis));
    };
    return {coordinate(abc[0], -q / abc[0], k6, k2 * k3 * k7 - k2 * k5 * k6 - k3 * k4 * k6 + k1 * k6 * k6),
            coordinate(abc[1], -q / abc[1], k5, k1 * k3 * k7 - k1 * k5 * k6 - k3 * k4 * k5 + k2 * k5 * k5),
            coordinate(abc[2], -q / abc[2], k4, k1 * k2 * k7 - k2 * k4 * k5 - k1 * k4 * k6 + k3 * k4 * k4)};
}

}  // namespace isoatlas
