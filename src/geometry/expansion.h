// Numbers that doubles do not hold, as sums of doubles: expansions (Shewchuk, Discrete Comput. Geom. 18, 1997), for predicates that are
// exact.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "base/error_free.h"

namespace isoatlas {

/// The sum of the first `size` parts, which do not overlap, ascend in magnitude and are not 0. Exact while products of factors stay in the
/// range of error_free.h.
template <std::size_t capacity>
struct Expansion {
    std::array<double, capacity> parts;
    std::size_t size = 0;

    void append(double part) {
        if (part != 0) parts[size++] = part;
    }
    /// The largest part has the sign of the sum.
    [[nodiscard]] int sign() const { return size == 0 ? 0 : parts[size - 1] > 0 ? 1 : -1; }
    Expansion operator-() const {
        Expansion negated = *this;
        for (std::size_t i = 0; i < size; ++i) negated.parts[i] = -parts[i];
        return negated;
    }
};

/// Merges by magnitude: Shewchuk's FAST-EXPANSION-SUM.
template <std::size_t m, std::size_t n>
Expansion<m + n> operator+(const Expansion<m>& e, const Expansion<n>& f) {
    Expansion<m + n> sum;
    std::size_t i = 0, j = 0;
    const auto take = [&] {
        const bool from_e = j == f.size || (i < e.size && std::abs(e.parts[i]) < std::abs(f.parts[j]));
        return from_e ? e.parts[i++] : f.parts[j++];
    };
    if (e.size + f.size == 0) return sum;
    double high = take();
    while (i < e.size || j < f.size) {
        const TwoDoubles next = two_sum(high, take());
        sum.append(next.low);
        high = next.high;
    }
    sum.append(high);
    return sum;
}

template <std::size_t m, std::size_t n>
Expansion<m + n> operator-(const Expansion<m>& e, const Expansion<n>& f) {
    return e + -f;
}

/// Shewchuk's SCALE-EXPANSION.
template <std::size_t n>
Expansion<2 * n> operator*(const Expansion<n>& e, double factor) {
    Expansion<2 * n> product;
    if (e.size == 0 || factor == 0) return product;
    TwoDoubles sum = PlainProduct()(e.parts[0], factor);
    product.append(sum.low);
    for (std::size_t i = 1; i < e.size; ++i) {
        const TwoDoubles next = PlainProduct()(e.parts[i], factor);
        const TwoDoubles middle = two_sum(sum.high, next.low);
        product.append(middle.low);
        sum = fast_two_sum(next.high, middle.high);
        product.append(sum.low);
    }
    product.append(sum.high);
    return product;
}

/// a b - c d.
inline Expansion<4> difference_of_products(double a, double b, double c, double d) {
    Expansion<2> first, second;
    const TwoDoubles p = PlainProduct()(a, b), q = PlainProduct()(c, d);
    first.append(p.low), first.append(p.high);
    second.append(q.low), second.append(q.high);
    return first - second;
}

}  // namespace isoatlas
