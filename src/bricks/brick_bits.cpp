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
    const auto behind = [&size](std::size_t axis) { return static_cast<std::uint16_t>(0xff & ~(0xff >> (kSide - size[axis]))); };
    BrickFaces sides;
    sides.low[1] = behind(1), sides.low[2] = behind(2);
    std::uint16_t all = 0xffff;
    for (std::int64_t z = 0; z < size[2]; ++z) {
        for (std::int64_t y = 0; y < size[1]; ++y) {
            const std::uint16_t row = bits[static_cast<std::size_t>(y + kSide * z)];
            const int has_high = row != 0, has_low = row != whole;
            sides.high[0] |= row;
            all &= row;
            sides.high[1] |= static_cast<std::uint16_t>(has_high << y), sides.low[1] |= static_cast<std::uint16_t>(has_low << y);
            sides.high[2] |= static_cast<std::uint16_t>(has_high << z), sides.low[2] |= static_cast<std::uint16_t>(has_low << z);
        }
    }
    sides.low[0] = static_cast<std::uint16_t>(~all);
    return sides;
}

#define ISOATLAS_INSTANTIATE(T) template BrickBits bits_of_brick<T>(const T*, const Index3&, T);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
