#include "levelset/candidate_words.h"

#include "levelset/level_bricks.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBricksOfWord = 64 / kBrickRow;

/// Which classes there are: bit 0 Low, bit 1 High.
using Classes = std::uint8_t;
constexpr Classes kLow = 1, kBoth = 3;
static_assert(static_cast<int>(BrickClass::low) == 0 && static_cast<int>(BrickClass::high) == 1 &&
              static_cast<int>(BrickClass::divided) == 2);
constexpr Classes classes_of(BrickClass brick) { return static_cast<Classes>(static_cast<int>(brick) + 1); }

/// By row of bricks and word: the classes of the bricks that its cells touch; behind the last row one of the outside.
std::vector<Classes> classes_of_words(const LevelBricks& bricks, std::int64_t words) {
    const Index3& size = bricks.grid.size;
    const std::int64_t rows = size[1] * size[2];
    std::vector<Classes> classes(static_cast<std::size_t>(words * (rows + 1)), kLow);
    std::vector<Classes> line(static_cast<std::size_t>(kBricksOfWord * words + 1), kLow);  // of a row, from the outside before it on
    const bool ends_early = bricks.grid.extent.size[0] % kBrickRow != 0;  // the outside begins before the end of a full brick
    for (std::int64_t row = 0; row < rows; ++row) {
        for (std::int64_t x = 0; x < size[0]; ++x)
            line[static_cast<std::size_t>(x + 1)] = classes_of(bricks.classes[BrickId(x + size[0] * row)]);
        if (ends_early) line[static_cast<std::size_t>(size[0])] |= kLow;
        for (std::int64_t w = 0; w < words; ++w) {  // positions 64 w to 64 w + 64, and position p is voxel p - 1
            Classes& word = classes[static_cast<std::size_t>(w + words * row)];
            word = 0;
            for (std::int64_t x = 0; x <= kBricksOfWord; ++x) word |= line[static_cast<std::size_t>(kBricksOfWord * w + x)];
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
    const std::vector<Classes> classes = classes_of_words(bricks, words);
    const std::int64_t ny = bricks.grid.size[1], nz = bricks.grid.size[2];
    const auto row_at = [&](std::int64_t y, std::int64_t z) {
        return classes.data() + words * (y < 0 || z < 0 || y >= ny || z >= nz ? ny * nz : y + ny * z);
    };
    for (std::int64_t g = 0; g < groups_[0] * groups_[1]; ++g) {
        const std::int64_t gy = g % groups_[0], gz = g / groups_[0];
        const std::int64_t y0 = (gy + 1) / 2 - 1, y1 = gy / 2, z0 = (gz + 1) / 2 - 1, z1 = gz / 2;
        const Classes *a = row_at(y0, z0), *b = row_at(y1, z0), *c = row_at(y0, z1), *d = row_at(y1, z1);
        for (std::int64_t w = 0; w < words; ++w) {
            if ((a[w] | b[w] | c[w] | d[w]) == kBoth) bits_[size_ * g + w / 64] |= std::uint64_t{1} << w % 64;
        }
    }
}

}  // namespace isoatlas
