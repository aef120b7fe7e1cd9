#include "levelset/high_bits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "field/require_isovalue.h"
#include "field/slab_work.h"
#include "levelset/level_bricks.h"
#include "levelset/threshold.h"

namespace isoatlas {
namespace {

/// 64 flags of one byte (0 or 1) as 64 bits.
std::uint64_t pack(const std::uint8_t* flags) {
    std::uint64_t word = 0;
    if constexpr (std::endian::native == std::endian::little) {
        for (int i = 0; i < 8; ++i) {
            std::uint64_t eight;
            std::memcpy(&eight, flags + 8 * i, 8);
            word |= eight * 0x0102040810204080ULL >> 56 << 8 * i;  // gathers bit 0 of each byte in the top byte
        }
    } else {
        for (int i = 0; i < 64; ++i) word |= std::uint64_t{flags[i]} << i;
    }
    return word;
}

template <class T>
void classify_row(const T* values, std::int64_t n, T min, std::uint64_t* row) {
    alignas(64) std::array<std::uint8_t, 64> flags;
    std::array<T, 64> last{};  // of a row that ends within a word, filled up
    std::uint64_t carry = 0;   // bit p is voxel p - 1: everything moves up by one
    std::int64_t w = 0;
    for (std::int64_t x = 0; x < n; x += 64, ++w) {
        const std::int64_t left = n - x;
        if (left < 64) std::copy_n(values + x, left, last.begin());
        const T* from = left < 64 ? last.data() : values + x;
        for (std::size_t i = 0; i < 64; ++i) flags[i] = from[i] >= min;
        const std::uint64_t word = pack(flags.data()) & (left < 64 ? ~(~std::uint64_t{0} << left) : ~std::uint64_t{0});
        row[w] = word << 1 | carry;
        carry = word >> 63;
    }
    row[w] = carry;
}

std::int64_t words_of(const Extent& extent) { return (extent.size[0] + 2 + 63) / 64; }

}  // namespace

HighBits::HighBits(const Extent& extent)
    : extent_(extent),
      words_(words_of(extent)),
      candidates_(words_),
      bits_(static_cast<std::size_t>(stride() * extent.size[1] * extent.size[2]), 0),
      zero_row_(static_cast<std::size_t>(stride())) {}

HighBits::HighBits(const LevelBricks& bricks)
    : extent_(bricks.grid.extent),
      words_(words_of(extent_)),
      candidates_(bricks, words_),
      bits_(static_cast<std::size_t>(stride() * extent_.size[1] * extent_.size[2])),
      zero_row_(static_cast<std::size_t>(stride())) {}

HighBits classify(const Volume& volume, double tau, const Context& context) {
    require_isovalue(tau);
    HighBits high(volume.info.extent);
    visit_samples(volume, [&](auto samples) {
        using T = typename decltype(samples)::value_type;
        const GridView<T> grid{samples.data(), volume.info.extent};
        const Threshold<T> threshold = threshold_for<T>(tau);
        if (threshold.none_high) return;
        for_each_row(context, kCutPhases["classify"], grid.extent, [&](std::int64_t y, std::int64_t z) {
            classify_row(grid.row(y, z), grid.extent.size[0], threshold.min, high.row(y, z));
        });
    });
    return high;
}

}  // namespace isoatlas
