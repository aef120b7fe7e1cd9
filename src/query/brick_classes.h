// The classes of whole bricks and of rows of a brick, as bits.
#pragma once

#include <array>
#include <cstring>
#include <functional>

#include "query/high_bits.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace isoatlas {

/// Sets bits [p, p + 16) of a row of classes; positions as in HighBits.
inline void put_bits(std::uint64_t* row, std::int64_t p, std::uint64_t bits) {
    row[p / 64] |= bits << p % 64;
    if (p % 64 > 48) row[p / 64 + 1] |= bits >> (64 - p % 64);
}

/// The same for `count` (at most 16) bits that hold something.
inline void replace_bits(std::uint64_t* row, std::int64_t p, std::int64_t count, std::uint64_t bits) {
    const std::uint64_t mask = 0xffff >> (store::kBrickRow - count);
    row[p / 64] &= ~(mask << p % 64);
    if (p % 64 > 48) row[p / 64 + 1] &= ~(mask >> (64 - p % 64));
    put_bits(row, p, bits);
}

#if defined(__SSE2__)
/// Which of 16 samples are at least `least`, as bits.
template <class T>
std::uint64_t bits_of_samples(const T* values, T least) {
    typedef T Samples __attribute__((vector_size(16)));  // NOLINT(modernize-use-using): an alias template would lose the attribute
    std::array<__m128i, sizeof(T)> masks;                // one, two, four or eight times 16 bytes of samples
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        Samples samples;
        std::memcpy(&samples, values + i * 16 / sizeof(T), 16);
        masks[i] = reinterpret_cast<__m128i>(samples >= least);
    }
    if constexpr (sizeof(T) == 8) {
        for (std::size_t i = 0; i < 4; ++i)
            masks[i] = _mm_castps_si128(_mm_shuffle_ps(_mm_castsi128_ps(masks[2 * i]), _mm_castsi128_ps(masks[2 * i + 1]), 0x88));
    }
    if constexpr (sizeof(T) >= 4) masks[0] = _mm_packs_epi32(masks[0], masks[1]), masks[1] = _mm_packs_epi32(masks[2], masks[3]);
    if constexpr (sizeof(T) >= 2) masks[0] = _mm_packs_epi16(masks[0], masks[1]);
    return static_cast<std::uint64_t>(_mm_movemask_epi8(masks[0]));
}
#else
template <class T>
std::uint64_t bits_of_samples(const T* values, T least) {
    std::array<std::uint8_t, store::kBrickRow> flags;
    for (std::int64_t i = 0; i < store::kBrickRow; ++i) flags[static_cast<std::size_t>(i)] = values[i] >= least;
    std::array<std::uint64_t, 2> eight;
    std::memcpy(eight.data(), flags.data(), sizeof eight);
    constexpr std::uint64_t kGather = 0x0102040810204080;  // bit 0 of each byte to the top byte
    return eight[0] * kGather >> 56 | eight[1] * kGather >> 56 << 8;
}
#endif

/// The classes of `count` (at most 16) samples.
template <class T>
std::uint64_t bits_of_samples(const T* values, std::int64_t count, T least) {
    if (count == store::kBrickRow) return bits_of_samples(values, least);
    std::uint64_t bits = 0;
    for (std::int64_t x = 0; x < count; ++x) bits |= std::uint64_t{values[x] >= least} << x;
    return bits;
}

/// Which bricks are High or Low as a whole, and beside a brick of another class or, if High, at an end of the grid?
[[nodiscard]] std::vector<std::uint8_t> touching_others(const store::BrickGrid& grid, const std::vector<BrickClass>& classes);

/// Of a brick that touches others: is there something else among the samples around it that matter (query/brick_surroundings.h)?
[[nodiscard]] bool is_beside_surface(const HighBits& high, const store::BrickGrid& grid, const std::vector<BrickClass>& classes,
                                     std::int64_t brick);
/// All of these.
[[nodiscard]] std::vector<std::int64_t> beside_surface(const HighBits& high, const store::BrickGrid& grid,
                                                       const std::vector<BrickClass>& classes, int threads);

/// The flags of bricks, and of those around them; outside: those of what lies beyond the ends of the grid.
[[nodiscard]] std::vector<std::uint8_t> with_neighbours(const store::BrickGrid& grid, std::vector<std::uint8_t> flags,
                                                        std::uint8_t outside = 0);

/// The numbers of the flagged bricks.
[[nodiscard]] std::vector<std::int64_t> flagged(const std::vector<std::uint8_t>& flags);

/// Calls visit(brick) for all bricks, a layer at a time.
void for_bricks(const store::BrickGrid& grid, int threads, const std::function<void(std::int64_t)>& visit);

}  // namespace isoatlas
