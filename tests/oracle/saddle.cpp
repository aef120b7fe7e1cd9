#include "oracle/saddle.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/integer.hpp>

namespace oracle {
namespace {

// Corners of exponents -1074 to 1023 need 2,200 bits where all of them occur in one cell; the tests keep to what this holds.
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<1000, boost::multiprecision::digit_base_2, void, std::int64_t>,
                                  boost::multiprecision::et_off>;

}  // namespace

// With u = f_yz etc. the gradient vanishes where (x, y, z) solves three bilinear equations. Eliminating y and z from
// f_y = p(x) + q(x) z = 0 and f_z = r(x) + q(x) y = 0, where p = k2 + k4 x, r = k3 + k5 x, q = k6 + k7 x, leaves one quadratic equation in
// x: k1 q^2 - k4 r q - k5 p q + k7 p r = 0.
std::optional<CellSaddle> saddle_in_cell(const std::array<double, 8>& corner, bool joins_highs) {
    std::array<Real, 8> v;
    for (int k = 0; k < 8; ++k) v[k] = Real(corner[k]);
    const Real k0 = v[0], k1 = v[1] - v[0], k2 = v[2] - v[0], k3 = v[4] - v[0], k4 = v[3] - v[1] - v[2] + v[0],
               k5 = v[5] - v[1] - v[4] + v[0], k6 = v[6] - v[2] - v[4] + v[0], k7 = v[7] - v[6] - v[5] - v[3] + v[4] + v[2] + v[1] - v[0];
    const Real a = k1 * k7 * k7 - k4 * k5 * k7, b = 2 * (k1 * k6 * k7 - k4 * k5 * k6),
               c = k1 * k6 * k6 - k4 * k3 * k6 - k5 * k2 * k6 + k7 * k2 * k3;
    std::vector<Real> roots;
    if (a == 0) {
        if (b != 0) roots.push_back(-c / b);
    } else {
        const Real discriminant = b * b - 4 * a * c;
        if (discriminant <= 0) return std::nullopt;
        const Real root = sqrt(discriminant), large = b > 0 ? -b - root : -b + root;
        roots.push_back(large / (2 * a));
        if (large != 0) roots.push_back(2 * c / large);
    }
    const Real tiny = ldexp(Real(1), -400);
    for (const Real& x : roots) {
        const Real q = k6 + k7 * x;
        if (q == 0) continue;
        const Real z = -(k2 + k4 * x) / q, y = -(k3 + k5 * x) / q;
        const Real product = q * (k5 + k7 * y) * (k4 + k7 * z);
        if (joins_highs ? product <= 0 : product >= 0) continue;
        bool is_certain = true, is_inside = true;
        for (const Real& t : {x, y, z}) {
            if (abs(t) < tiny || abs(t - 1) < tiny) is_certain = false;
            if (t <= 0 || t >= 1) is_inside = false;
        }
        if (!is_inside && is_certain) continue;
        const Real value = k0 + (k1 * x + k2 * y + k3 * z + (k4 * x * y + k5 * x * z + k6 * y * z)) + k7 * x * y * z;
        auto below = value.convert_to<double>();
        while (Real(below) > value) below = std::nextafter(below, -std::numeric_limits<double>::infinity());
        while (Real(std::nextafter(below, std::numeric_limits<double>::infinity())) <= value) {
            below = std::nextafter(below, std::numeric_limits<double>::infinity());
        }
        const double above = std::nextafter(below, std::numeric_limits<double>::infinity());
        const Real scale = abs(k1) + abs(k2) + abs(k3) + abs(k4) + abs(k5) + abs(k6) + abs(k7);
        if (abs(value - Real(below)) < scale * tiny) return CellSaddle{below, is_certain};  // exact: 1,000 bits around a double
        if (abs(Real(above) - value) < scale * tiny) return CellSaddle{above, is_certain};
        return CellSaddle{below + 0.0, is_certain};
    }
    return std::nullopt;
}

}  // namespace oracle
