// Join and split trees of volumes drawn by hand (drawings.h).
#include "tree/merge_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/tree/drawings.h"

namespace isoatlas {
namespace {

TEST(JoinTree, ForksWhereTwoPeaksMeet) { EXPECT_EQ(list(two_peaks().join()), (Ids{2, 2, 3, 3})); }

//   A  B  C
//   `-3   |       3 names A and B, 4 names B and C: B stands for the object of A and B
//     `-4-'
TEST(JoinTree, AnyMaximumOfAnObjectStandsForIt) { EXPECT_EQ(list(islands().join()), (Ids{3, 3, 4, 4, 5, 6, 7, 7})); }

TEST(JoinTree, AHandleHasOneChild) { EXPECT_EQ(list(body().join()), (Ids{2, 2, 3, 4, 5, 6, 7, 7})); }

TEST(JoinTree, OfOneElementHangsOnTheOutside) { EXPECT_EQ(list(Drawing{{peak(0)}, {1}}.join()), (Ids{1, 1})); }

TEST(SplitTree, OfPeaksIsAPath) { EXPECT_EQ(list(two_peaks().split()), (Ids{0, 0, 1, 2})); }

// Going up, the cavity (node 2) and the outside (node 3) meet in the element that parts them going down.
TEST(SplitTree, ForksWhereACavityMeetsTheOutside) { EXPECT_EQ(list(hollow_ball().split()), (Ids{0, 0, 1, 1})); }

TEST(SplitTree, AFilledRingHasOneChild) { EXPECT_EQ(list(body().split()), (Ids{0, 0, 1, 2, 3, 4, 5, 5})); }

TEST(MergeTrees, OfCriticalElementsAreThoseOfTheirRepresentatives) {
    for (const Drawing& drawing : {two_peaks(), hollow_ball(), islands(), body()}) {
        EXPECT_EQ(list(join_tree(drawing.critical_set())), list(drawing.join()));
        EXPECT_EQ(list(split_tree(drawing.critical_set())), list(drawing.split()));
    }
}

TEST(MergeTrees, AreTheSameForBothWidthsOfIds) {
    const Ids join = list(body().join()), split = list(body().split());
    const auto wide_join = list(join_tree(body().critical_set<std::uint64_t>())),
               wide_split = list(split_tree(body().critical_set<std::uint64_t>()));
    EXPECT_TRUE(std::ranges::equal(join, wide_join));
    EXPECT_TRUE(std::ranges::equal(split, wide_split));
}

}  // namespace
}  // namespace isoatlas
