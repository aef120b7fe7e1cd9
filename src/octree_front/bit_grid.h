// BitGrid: one bit for each block, or vertex, of a level of an octree; rows along x, 64 bits a word.
#pragma once

#include <cstdint>
#include <vector>

#include "base/big_vector.h"
#include "isoatlas/index3.h"

namespace isoatlas {

class BitGrid {
public:
    BitGrid() = default;
    /// All bits are `value`, and those outside stay so.
    BitGrid(const Index3& size, bool value)
        : size_(size),
          words_((size[0] + 63) / 64),
          bits_(static_cast<std::size_t>(words_ * size[1] * size[2]), value ? ~std::uint64_t{0} : 0),
          outside_(value ? ~std::uint64_t{0} : 0) {}

    [[nodiscard]] const Index3& size() const { return size_; }
    [[nodiscard]] std::int64_t words() const { return words_; }
    /// Null outside.
    [[nodiscard]] const std::uint64_t* row(std::int64_t y, std::int64_t z) const {
        return y < 0 || z < 0 || y >= size_[1] || z >= size_[2] ? nullptr : bits_.data() + words_ * (y + size_[1] * z);
    }
    [[nodiscard]] std::uint64_t* row(std::int64_t y, std::int64_t z) { return bits_.data() + words_ * (y + size_[1] * z); }
    /// Word w of a row of row().
    [[nodiscard]] std::uint64_t word(const std::uint64_t* row, std::int64_t w) const {
        return row == nullptr || w >= words_ ? outside_ : row[w];
    }
    [[nodiscard]] bool operator[](const Index3& at) const {
        return at[0] >= 0 && (word(row(at[1], at[2]), at[0] / 64) >> at[0] % 64 & 1) != 0;
    }
    void set(const Index3& at) { row(at[1], at[2])[at[0] / 64] |= std::uint64_t{1} << at[0] % 64; }

private:
    Index3 size_{};
    std::int64_t words_ = 0;
    BigVector<std::uint64_t> bits_;
    std::uint64_t outside_ = 0;
};

/// Bits 0, 2, 4, ... of a word, as its lower half. Word: 64 bits, or a vector of words.
template <class Word>
[[nodiscard, gnu::always_inline]] constexpr Word even_bits(Word word) {
    word &= 0x5555555555555555;
    word = (word | word >> 1) & 0x3333333333333333;
    word = (word | word >> 2) & 0x0f0f0f0f0f0f0f0f;
    word = (word | word >> 4) & 0x00ff00ff00ff00ff;
    word = (word | word >> 8) & 0x0000ffff0000ffff;
    return (word | word >> 16) & 0x00000000ffffffff;
}
/// Those of two words.
template <class Word>
[[nodiscard, gnu::always_inline]] constexpr Word even_bits(Word first, Word second) {
    return even_bits(first) | even_bits(second) << 32;
}

}  // namespace isoatlas
