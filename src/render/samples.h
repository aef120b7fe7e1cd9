// Pseudo-random numbers in [0, 1) that depend only on pixel, sample and purpose, so that pictures do not depend on threads.
#pragma once

#include <cmath>
#include <cstdint>

namespace isoatlas {

/// Mixes 32 bits (the finalizer of MurmurHash3).
inline std::uint32_t hash(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x85ebca6bU;
    x = (x ^ (x >> 13)) * 0xc2b2ae35U;
    return x ^ (x >> 16);
}
inline std::uint32_t hash(std::uint32_t x, std::uint32_t y) { return hash(x ^ (hash(y) + 0x9e3779b9U + (x << 6) + (x >> 2))); }
inline double fraction_of(std::uint32_t bits) { return bits * 0x1p-32; }

struct Sample2 {
    double u, v;
};

/// Point i of a low-discrepancy sequence in the square (Roberts' R2), shifted by `seed`.
inline Sample2 sample_2d(std::uint32_t seed, std::uint32_t i) {
    constexpr std::uint32_t kFirst = 3242174889U, kSecond = 2447445414U;  // 2^32 / g, 2^32 / g^2 with g^3 = g + 1: wrap like fractions
    return {fraction_of(hash(seed) + i * kFirst), fraction_of(hash(seed ^ 0x68bc21ebU) + i * kSecond)};
}

}  // namespace isoatlas
