// Samples of 16 bits in floating point (binary16 of IEEE 754) as float32, which has all their values.
#pragma once

#include <bit>
#include <cstdint>

namespace isoatlas {

/// Infinite and not-a-number stay what they are.
[[nodiscard]] inline float float_of_half(std::uint16_t bits) {
    const std::uint32_t sign = static_cast<std::uint32_t>(bits & 0x8000U) << 16, exponent = bits >> 10 & 0x1fU, fraction = bits & 0x3ffU;
    if (exponent == 0) {  // zero and subnormal numbers: multiples of 2^-24, which float32 has as normal ones
        const float magnitude = static_cast<float>(fraction) * 0x1p-24F;
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(magnitude) | sign);
    }
    const std::uint32_t wide = exponent == 0x1f ? 0xffU : exponent + 127 - 15;
    return std::bit_cast<float>(sign | wide << 23 | fraction << 13);
}

}  // namespace isoatlas
