// The classes of all samples at one isovalue: one bit a voxel, High = 1.
//
// A row (y, z) is a bit string with one padding bit at each end: bit p is voxel x = p - 1, so cell p of a row has the corners p and p + 1.
// Rows outside the volume are all Low. Memory: 1 bit a voxel plus at most 24 bytes a row.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "field/grid.h"
#include "isoatlas/context.h"
#include "isoatlas/volume.h"
#include "levelset/candidate_words.h"

namespace isoatlas {

class HighBits {
public:
    /// All Low.
    explicit HighBits(const Extent& extent);
    /// Only candidate words (levelset/candidate_words.h) need be read. Rows are uninitialised until they are written.
    explicit HighBits(const LevelBricks& bricks);

    /// Finds the candidate words of other bricks. The rows keep their bits.
    void set_candidates(const LevelBricks& bricks) { candidates_ = CandidateWords(bricks, words_); }

    [[nodiscard]] const Extent& extent() const { return extent_; }
    /// Words of a row; one more zero word follows, so word w + 1 may always be read.
    [[nodiscard]] std::int64_t words() const { return words_; }
    /// Words of row (y, z) of cells, y and z from -1, that may hold active cells.
    [[nodiscard]] WordSet candidates(std::int64_t y, std::int64_t z) const { return candidates_.of(y, z); }
    [[nodiscard]] const std::uint64_t* row(std::int64_t y, std::int64_t z) const {
        const bool inside = y >= 0 && y < extent_.size[1] && z >= 0 && z < extent_.size[2];
        return inside ? bits_.data() + (y + extent_.size[1] * z) * stride() : zero_row_.data();
    }
    [[nodiscard]] std::uint64_t* row(std::int64_t y, std::int64_t z) { return bits_.data() + (y + extent_.size[1] * z) * stride(); }

private:
    [[nodiscard]] std::int64_t stride() const { return words_ + 1; }
    Extent extent_;
    std::int64_t words_;
    CandidateWords candidates_;
    BigVector<std::uint64_t> bits_;
    std::vector<std::uint64_t> zero_row_;
};

/// Classifies every sample of the volume. Throws Error{usage} when tau is not finite. Cost: one read of the volume.
[[nodiscard]] HighBits classify(const Volume& volume, double tau, const Context& context);

/// Bit p of word w of `row` next to bit p + 1 and p - 1.
inline std::uint64_t bits_after(const std::uint64_t* row, std::int64_t w) { return row[w] >> 1 | row[w + 1] << 63; }
inline std::uint64_t bits_before(const std::uint64_t* row, std::int64_t w) { return row[w] << 1 | (w > 0 ? row[w - 1] >> 63 : 0); }

}  // namespace isoatlas
