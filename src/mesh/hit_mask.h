// HitMask: some of the hits of a level, one bit an edge of the grid, and the order among those of a row.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "base/big_vector.h"

namespace isoatlas {

/// Bit p of word w of a row and an axis: the edge along the axis that begins at position 64 w + p of the row (levelset/high_bits.h).
class HitMask {
public:
    /// Nothing is known of a row before it is cleared. Memory: 4.5 bits an edge of one axis, of which only the rows that are cleared are
    /// touched.
    HitMask(std::int64_t rows, std::int64_t words) : words_(words) {
        resize_for_overwrite(bits_, static_cast<std::size_t>(3 * rows * words));
        resize_for_overwrite(before_, bits_.size());
    }

    [[nodiscard]] std::array<const std::uint64_t*, 3> rows(std::int64_t row) const {
        const std::uint64_t* const first = bits_.data() + 3 * row * words_;
        return {first, first + words_, first + 2 * words_};
    }
    void clear(std::int64_t row) { std::fill_n(bits_.data() + 3 * row * words_, 3 * words_, std::uint64_t{0}); }
    void add(std::int64_t row, int axis, std::int64_t position) { bits_[place(row, axis, position)] |= std::uint64_t{1} << position % 64; }
    /// After the last add(): numbers the hits of a row along each axis. Returns how many there are.
    std::array<std::uint32_t, 3> number(std::int64_t row) {
        std::array<std::uint32_t, 3> count{};
        for (int axis = 0; axis < 3; ++axis) {
            for (std::size_t i = place(row, axis, 0), end = i + static_cast<std::size_t>(words_); i < end; ++i) {
                before_[i] = count[static_cast<std::size_t>(axis)];
                count[static_cast<std::size_t>(axis)] += static_cast<std::uint32_t>(std::popcount(bits_[i]));
            }
        }
        return count;
    }
    /// How many hits of the row and axis lie before this one.
    [[nodiscard]] std::int64_t rank(std::int64_t row, int axis, std::int64_t position) const {
        const std::size_t at = place(row, axis, position);
        return before_[at] + std::popcount(bits_[at] & ((std::uint64_t{1} << position % 64) - 1));
    }

private:
    [[nodiscard]] std::size_t place(std::int64_t row, int axis, std::int64_t position) const {
        return static_cast<std::size_t>((3 * row + axis) * words_ + position / 64);
    }
    std::int64_t words_;
    BigVector<std::uint64_t> bits_;
    BigVector<std::uint32_t> before_;
};

}  // namespace isoatlas
