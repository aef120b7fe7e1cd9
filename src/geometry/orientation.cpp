#include "geometry/orientation.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <span>

#include "geometry/expansion.h"

namespace isoatlas {
namespace {

using boost::multiprecision::cpp_int;

constexpr int kMinExponent = -250, kMaxExponent = 250;  // products of three coordinates and their last bits stay far from overflow

template <std::size_t n>
bool expansions_hold(const std::array<double, n>& point) {
    for (const double x : point)
        if (x != 0 && (std::abs(x) < std::ldexp(1.0, kMinExponent) || std::abs(x) > std::ldexp(1.0, kMaxExponent))) return false;
    return true;
}

/// In units of the last bit of the smallest double.
cpp_int integer(double x) {
    constexpr int kDigits = 53, kLastBit = -1074;
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), kDigits));
    const int shift = exponent - kDigits - kLastBit;
    return shift >= 0 ? cpp_int(cpp_int(mantissa) << shift) : cpp_int(mantissa / (std::int64_t{1} << -shift));  // no bits are lost
}

template <std::size_t n>
std::array<cpp_int, n> difference(const std::array<double, n>& a, const std::array<double, n>& b) {
    std::array<cpp_int, n> result;
    for (std::size_t i = 0; i < n; ++i) result[i] = integer(a[i]) - integer(b[i]);
    return result;
}

int orientation_of_integers(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto u = difference(b, a), v = difference(c, a), w = difference(d, a);
    const cpp_int value = (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] + (u[0] * v[1] - u[1] * v[0]) * w[2];
    return value.sign();
}

int orientation_of_integers(const Vec2& a, const Vec2& b, const Vec2& c) {
    const auto u = difference(b, a), v = difference(c, a);
    const cpp_int value = u[0] * v[1] - u[1] * v[0];
    return value.sign();
}

/// Rows of the determinant are a coordinate and 1: of the points projected along z.
Expansion<4> minor_of(const Vec3& a, const Vec3& b) { return difference_of_products(a[0], b[1], b[0], a[1]); }

/// Flat pieces of a surface lie across an axis more often than not.
bool share_a_coordinate(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    for (std::size_t i = 0; i < 3; ++i)
        if (a[i] == b[i] && a[i] == c[i] && a[i] == d[i]) return true;
    return false;
}

}  // namespace

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    if (share_a_coordinate(a, b, c, d)) return 0;
    if (!(expansions_hold(a) && expansions_hold(b) && expansions_hold(c) && expansions_hold(d))) return orientation_of_integers(a, b, c, d);
    const Expansion<4> ab = minor_of(a, b), bc = minor_of(b, c), cd = minor_of(c, d), da = minor_of(d, a), ac = minor_of(a, c),
                       bd = minor_of(b, d);
    const Expansion<12> bcd = bc + cd - bd, cda = cd + da + ac, dab = da + ab + bd, abc = ab + bc - ac;
    return (cda * b[2] + abc * d[2] - (bcd * a[2] + dab * c[2])).sign();
}

int exact_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
    if (!(expansions_hold(a) && expansions_hold(b) && expansions_hold(c))) return orientation_of_integers(a, b, c);
    const auto of_two = [](const Vec2& p, const Vec2& q) { return difference_of_products(p[0], q[1], q[0], p[1]); };
    return (of_two(a, b) + of_two(b, c) + of_two(c, a)).sign();
}

}  // namespace isoatlas
