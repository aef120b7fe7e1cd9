#include "bricks/brick_bits.h"

#include <cstring>

#include "base/sample_types.h"
#include "levelset/high_bits.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace isoatlas {
namespace {

constexpr std::int64_t kRow = kBrickRow, kSide = kBrickSize[1];

#if defined(__SSE2__)
/// Bit mask of those of 16 samples that are >= `min`.
template <class T>
std::uint16_t bits_of_row(const T* samples, T min) {
    typedef T Vector __attribute__((vector_size(16)));  // NOLINT(modernize-use-using): an alias template would lose the attribute
    __m128i masks[sizeof(T)];                           // one, two, four or eight times 16 bytes of samples
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        Vector vector;
        std::memcpy(&vector, samples + i * 16 / sizeof(T), 16);
        masks[i] = reinterpret_cast<__m128i>(vector >= min);
    }
    if constexpr (sizeof(T) == 8) {
        for (std::size_t i = 0; i < 4; ++i)
            masks[i] = _mm_castps_si128(_mm_shuffle_ps(_mm_castsi128_ps(masks[2 * i]), _mm_castsi128_ps(masks[2 * i + 1]), 0x88));
    }
    if constexpr (sizeof(T) >= 4) masks[0] = _mm_packs_epi32(masks[0], masks[1]), masks[1] = _mm_packs_epi32(masks[2], masks[3]);
    if constexpr (sizeof(T) >= 2) masks[0] = _mm_packs_epi16(masks[0], masks[1]);
    return static_cast<std::uint16_t>(_mm_movemask_epi8(masks[0]));
}
#else
template <class T>
std::uint16_t bits_of_row(const T* samples, T min) {
    std::uint16_t bits = 0;
    for (std::int64_t x = 0; x < kRow; ++x) bits |= static_cast<std::uint16_t>((samples[x] >= min) << x);
    return bits;
}
#endif

/// One for each row of a brick, 0 or 1; bytes, so that compilers take vectors.
using RowFlags = std::array<std::uint8_t, static_cast<std::size_t>(kBrickRows)>;

/// Layers along y, along z, with a row that has a flag.
std::array<std::uint16_t, 2> layers_of(const RowFlags& flags) {
    std::uint64_t rows = 0;  // of all slices, a byte each
    std::array<std::uint16_t, 2> layers{};
    for (std::int64_t z = 0; z < kBrickSize[2]; ++z) {
        std::uint64_t slice;
        static_assert(kSide == sizeof slice);
        std::memcpy(&slice, flags.data() + kSide * z, sizeof slice);
        rows |= slice;
        layers[1] |= static_cast<std::uint16_t>((slice != 0) << z);
    }
    for (std::int64_t y = 0; y < kSide; ++y) layers[0] |= static_cast<std::uint16_t>((rows >> 8 * y & 1) << y);
    return layers;
}

}  // namespace

template <class T>
BrickBits bits_of_brick(const T* samples, const Index3& size, T min) {
    BrickBits bits{};
    const auto columns = static_cast<std::uint16_t>(0xffff >> (kRow - size[0]));
    for (std::int64_t z = 0; z < size[2]; ++z) {
        for (std::int64_t y = 0; y < size[1]; ++y) {
            const std::int64_t row = y + kSide * z;
            bits[static_cast<std::size_t>(row)] = bits_of_row(samples + kRow * row, min) & columns;
        }
    }
    return bits;
}

BrickBits whole_brick(const Index3& size) {
    BrickBits bits{};
    for (std::int64_t z = 0; z < size[2]; ++z) {
        for (std::int64_t y = 0; y < size[1]; ++y)
            bits[static_cast<std::size_t>(y + kSide * z)] = static_cast<std::uint16_t>(0xffff >> (kRow - size[0]));
    }
    return bits;
}

void put_brick(const BrickBits& bits, const Box& box, HighBits& high) {
    const std::int64_t first = box.begin[0] + 1;  // position p is voxel p - 1
    const std::int64_t word = first / 64, shift = first % 64;
    const std::uint64_t columns = 0xffff >> (kRow - box.size(0));
    for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
        for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) {
            const std::uint64_t own = bits[static_cast<std::size_t>(y - box.begin[1] + kSide * (z - box.begin[2]))];
            std::uint64_t* const row = high.row(y, z) + word;
            row[0] = (row[0] & ~(columns << shift)) | own << shift;
            if (shift > 48) row[1] = (row[1] & ~(columns >> (64 - shift))) | own >> (64 - shift);
        }
    }
}

BrickFaces sides_of(const BrickBits& bits, const Index3& size) {
    const auto whole = static_cast<std::uint16_t>(0xffff >> (kRow - size[0]));
    RowFlags has_high, has_low;
    std::uint16_t any = 0, all = 0xffff;
    for (std::size_t row = 0; row < bits.size(); ++row) {
        any |= bits[row];
        has_high[row] = bits[row] != 0, has_low[row] = bits[row] != whole;
    }
    for (std::int64_t z = 0; z < kBrickSize[2]; ++z) {
        for (std::int64_t y = 0; y < kSide; ++y) {
            const auto row = static_cast<std::size_t>(y + kSide * z);
            if (y < size[1] && z < size[2])
                all &= bits[row];
            else
                has_low[row] = 0;
        }
    }
    const auto behind = [&size](std::size_t axis) { return static_cast<std::uint16_t>(0xff & ~(0xff >> (kSide - size[axis]))); };
    const auto [high_y, high_z] = layers_of(has_high);
    const auto [low_y, low_z] = layers_of(has_low);
    return {
        {any, high_y, high_z},
        {static_cast<std::uint16_t>(~all), static_cast<std::uint16_t>(low_y | behind(1)), static_cast<std::uint16_t>(low_z | behind(2))}};
}

#define ISOATLAS_INSTANTIATE(T) template BrickBits bits_of_brick<T>(const T*, const Index3&, T);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
