// A word that is not busy holds no active cell, whatever the samples of divided bricks are; where bricks differ, words are busy.
#include "levelset/candidate_words.h"
#include "levelset/level_bricks.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

namespace isoatlas {
namespace {

LevelBricks arbitrary_bricks() {
    Extent extent;
    extent.size = {*rc::gen::inRange<std::int64_t>(1, 300), *rc::gen::inRange<std::int64_t>(1, 50), *rc::gen::inRange<std::int64_t>(1, 50)};
    LevelBricks bricks{BrickGrid(extent), {}, {}, {}};
    bricks.classes.items().assign(static_cast<std::size_t>(bricks.grid.count()), *rc::gen::element(BrickClass::low, BrickClass::high));
    const auto others = *rc::gen::container<std::vector<int>>(rc::gen::inRange<int>(0, 3 * static_cast<int>(bricks.classes.size())));
    for (const int other : others) bricks.classes[BrickId(other / 3)] = static_cast<BrickClass>(other % 3);
    return bricks;
}

/// Classes of the bricks of the corners of a cell; outside everything is Low.
std::set<BrickClass> classes_around(const LevelBricks& bricks, std::int64_t p, std::int64_t y, std::int64_t z) {
    std::set<BrickClass> classes;
    for (int k = 0; k < 8; ++k) {
        const Index3 voxel{p - 1 + (k & 1), y + (k >> 1 & 1), z + (k >> 2)};
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis) inside = inside && voxel[axis] >= 0 && voxel[axis] < bricks.grid.extent.size[axis];
        classes.insert(inside ? bricks.classes[bricks.grid.brick(BrickGrid::place_of(voxel))] : BrickClass::low);
    }
    return classes;
}

RC_GTEST_PROP(CandidateWords, HoldAllCellsThatMayBeActive, ()) {
    const LevelBricks bricks = arbitrary_bricks();
    const Index3& size = bricks.grid.extent.size;
    const std::int64_t words = (size[0] + 2 + 63) / 64;
    const CandidateWords busy(bricks, words), all(words);
    for (std::int64_t z = -1; z < size[2]; z += *rc::gen::inRange(1, 9)) {
        for (std::int64_t y = -1; y < size[1]; y += *rc::gen::inRange(1, 9)) {
            std::vector<std::int64_t> expected, found, every;
            for (std::int64_t w = 0; w < words; ++w) {
                bool may_be_active = false;
                for (std::int64_t p = 64 * w; p < 64 * (w + 1) && p <= size[0]; ++p) {
                    const std::set<BrickClass> classes = classes_around(bricks, p, y, z);
                    may_be_active = may_be_active || classes.size() > 1 || classes.contains(BrickClass::divided);
                }
                if (may_be_active) expected.push_back(w);
            }
            busy.of(y, z).for_each([&](std::int64_t w) { found.push_back(w); });
            all.of(y, z).for_each([&](std::int64_t w) { every.push_back(w); });
            RC_ASSERT(std::ranges::includes(found, expected));
            RC_ASSERT(busy.of(y, z).empty() == found.empty());
            RC_ASSERT(every.size() == static_cast<std::size_t>(words));
        }
    }
}

TEST(CandidateWords, AreNoneWhereEverythingIsLow) {
    Extent extent;
    extent.size = {200, 40, 40};
    LevelBricks bricks{BrickGrid(extent), {}, {}, {}};
    bricks.classes.items().assign(static_cast<std::size_t>(bricks.grid.count()), BrickClass::low);
    bricks.classes[bricks.grid.brick({9, 1, 1})] = BrickClass::divided;  // voxels 144 to 159, positions 145 to 160: word 2
    const CandidateWords busy(bricks, 4);
    EXPECT_TRUE(busy.of(6, 12).empty());
    EXPECT_TRUE(busy.of(10, 16).empty());
    for (const std::int64_t y : {7, 10, 15}) {
        std::vector<std::int64_t> found;
        busy.of(y, 12).for_each([&](std::int64_t w) { found.push_back(w); });
        EXPECT_EQ(found, std::vector<std::int64_t>{2}) << y;
    }
}

}  // namespace
}  // namespace isoatlas
