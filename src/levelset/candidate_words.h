// CandidateWords: the words of the rows of cells that may hold active cells, found from bricks before any sample is read. Where all bricks
// around are of one class no cell is active.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "field/brick_grid.h"

namespace isoatlas {

struct LevelBricks;

/// Some of the words of a row.
struct WordSet {
    const std::uint64_t* bits;  ///< bit w % 64 of bits[w / 64]: is word w one of them?
    std::int64_t size;          ///< of `bits`

    [[nodiscard]] bool empty() const {
        std::uint64_t any = 0;
        for (std::int64_t i = 0; i < size; ++i) any |= bits[i];
        return any == 0;
    }
    /// Calls visit(w), w ascending.
    template <class Visit>
    void for_each(Visit&& visit) const {
        for (std::int64_t i = 0; i < size; ++i) {
            for (std::uint64_t rest = bits[i]; rest != 0;) {  // a stretch of ones at a time: often all of them
                const int begin = std::countr_zero(rest), end = begin + std::countr_one(rest >> begin);
                for (int w = begin; w < end; ++w) visit(64 * i + w);
                rest = end == 64 ? 0 : rest >> end << end;
            }
        }
    }
};

class CandidateWords {
public:
    /// All words of rows of `words` words: nothing is known.
    explicit CandidateWords(std::int64_t words);
    /// Words whose cells do not have all corners in bricks of one class; outside of the volume everything is Low.
    CandidateWords(const LevelBricks& bricks, std::int64_t words);

    /// Of row (y, z) of cells, y and z from -1 (levelset/active_cells.h).
    [[nodiscard]] WordSet of(std::int64_t y, std::int64_t z) const {
        return {bits_.data() + size_ * (group(0, y) + groups_[0] * group(1, z)), size_};
    }

private:
    /// Rows of cells between the same rows of bricks are a group: even numbers for those between two of them, odd ones for those inside
    /// one.
    [[nodiscard]] std::int64_t group(int axis, std::int64_t row) const {
        if (row + 1 >= rows_[axis]) return groups_[axis] - 1;
        const std::int64_t side = kBrickSize[axis + 1];
        return 2 * ((row + 1) / side) + ((row + 1) % side != 0);
    }

    std::int64_t size_;
    std::array<std::int64_t, 2> rows_, groups_;  ///< of the axes y and z
    std::vector<std::uint64_t> bits_;
};

}  // namespace isoatlas
