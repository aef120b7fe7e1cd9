#include "levelset/candidate_words.h"

#include <algorithm>

#include "levelset/level_bricks.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBricksOfWord = 64 / kBrickRow;

BrickClass both(BrickClass a, BrickClass b) { return a == b ? a : BrickClass::divided; }

/// Per row of bricks and word: the class of the bricks that its cells touch.
std::vector<BrickClass> classes_of_words(const LevelBricks& bricks, std::int64_t words) {
    const Index3& size = bricks.grid.size;
    std::vector<BrickClass> classes;
    classes.reserve(static_cast<std::size_t>(words * size[1] * size[2]));
    for (std::int64_t row = 0; row < size[1] * size[2]; ++row) {
        const auto class_at = [&](std::int64_t x) {
            if (x < 0 || x >= size[0]) return BrickClass::low;
            const bool ends_early = (x + 1) * kBrickRow > bricks.grid.extent.size[0];  // the outside begins before the end of a full brick
            const BrickClass own = bricks.classes[BrickId(x + size[0] * row)];
            return ends_early ? both(own, BrickClass::low) : own;
        };
        for (std::int64_t w = 0; w < words; ++w) {  // positions 64 w to 64 w + 64, and position p is voxel p - 1
            BrickClass word = class_at(kBricksOfWord * w - 1);
            for (std::int64_t x = kBricksOfWord * w; x < kBricksOfWord * (w + 1); ++x) word = both(word, class_at(x));
            classes.push_back(word);
        }
    }
    return classes;
}

}  // namespace

CandidateWords::CandidateWords(std::int64_t words)
    : size_((words + 63) / 64), rows_{0, 0}, groups_{1, 1}, bits_(static_cast<std::size_t>(size_), ~std::uint64_t{0}) {
    if (words % 64 != 0) bits_.back() >>= 64 - words % 64;
}

CandidateWords::CandidateWords(const LevelBricks& bricks, std::int64_t words)
    : size_((words + 63) / 64),
      rows_{bricks.grid.extent.size[1], bricks.grid.extent.size[2]},
      groups_{2 * bricks.grid.size[1] + 1, 2 * bricks.grid.size[2] + 1},
      bits_(static_cast<std::size_t>(size_ * groups_[0] * groups_[1])) {
    const std::vector<BrickClass> classes = classes_of_words(bricks, words);
    const std::int64_t ny = bricks.grid.size[1], nz = bricks.grid.size[2];
    const auto class_at = [&](std::int64_t y, std::int64_t z, std::int64_t w) {
        return y < 0 || z < 0 || y >= ny || z >= nz ? BrickClass::low : classes[w + words * (y + ny * z)];
    };
    for (std::int64_t g = 0; g < groups_[0] * groups_[1]; ++g) {
        const std::int64_t gy = g % groups_[0], gz = g / groups_[0];
        const std::int64_t y0 = (gy + 1) / 2 - 1, y1 = gy / 2, z0 = (gz + 1) / 2 - 1, z1 = gz / 2;
        for (std::int64_t w = 0; w < words; ++w) {
            const BrickClass around = both(both(class_at(y0, z0, w), class_at(y1, z0, w)), both(class_at(y0, z1, w), class_at(y1, z1, w)));
            if (around == BrickClass::divided) bits_[size_ * g + w / 64] |= std::uint64_t{1} << w % 64;
        }
    }
}

}  // namespace isoatlas
