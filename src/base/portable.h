// Arithmetic whose bits are the same on every IEEE machine: no libm function, whose last digit depends on the library, no std distribution.
// Only + - * / and sqrt (correctly rounded by IEEE 754) are used, in a fixed order and without contraction.
#pragma once

#include <cmath>
#include <cstdint>

namespace isoatlas {

/// cos(2 pi turns). Taylor series on a quarter turn; absolute error below 1e-15.
inline double cos_turns(double turns) {
    double r = std::fabs(turns - std::floor(turns + 0.5));  // 0..0.5 of a turn from the nearest top
    const double sign = r > 0.25 ? -1.0 : 1.0;
    if (r > 0.25) r = 0.5 - r;
    const double x = 6.283185307179586476925286766559 * r;
    const double x2 = x * x;
    double term = 1, sum = 1;
    for (int k = 1; k <= 12; ++k) {
        term = -term * x2 / static_cast<double>((2 * k - 1) * (2 * k));
        sum += term;
    }
    return sign * sum;
}

/// sin(2 pi turns).
inline double sin_turns(double turns) { return cos_turns(turns - 0.25); }

/// SplitMix64 (Steele, Lea, Flood 2014): a 64-bit counter pushed through a mixer; every seed gives a full period.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t bits() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    }
    /// Uniform in [0, 1), a multiple of 2^-53.
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }

private:
    std::uint64_t state_;
};

}  // namespace isoatlas
