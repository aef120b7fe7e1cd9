// Levels of volumes drawn by hand (drawings.h) whose values are made equal.
#include "tree/levels.h"
#include "tree/contour_tree.h"

#include <gtest/gtest.h>

#include "unit/tree/drawings.h"

namespace isoatlas {
namespace {

using Kinds = std::vector<LevelKind>;
using enum LevelKind;

struct Levels {
    Ids level;
    Kinds kind;

    explicit Levels(const Drawing& drawing, const std::vector<double>& values) {
        const ContourTree<Id> tree = drawing.contours();
        const auto value = by_element(values);
        const ByElement<Id, ElementKey> roots = level_roots<Id>(tree, value);
        level = list(roots);
        kind = list(level_kinds<Id>(tree, roots, value, drawing.delta_chi()));
    }
};

TEST(Levels, OfDistinctValuesAreTheElements) {
    const Levels levels(body(), body().values);
    EXPECT_EQ(levels.level, (Ids{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(levels.kind, (Kinds{maximum, maximum, merge, genus, genus, split, minimum}));
}

// A ring that opens and is filled at one value.
//   2
//   3 handle     58
//   4 filled     58
//   5
TEST(Levels, WhoseChangesCancelAreTrivial) {
    const Levels levels(body(), {100, 90, 60, 58, 58, 30, 20});
    EXPECT_EQ(levels.level, (Ids{0, 1, 2, 3, 3, 5, 6}));
    EXPECT_EQ(levels.kind[3], trivial);
}

//   A  B  C
//   `s1'  |     50: three contours in, one out
//     `s2-'     50
TEST(Levels, JoinSeveralMergesOfOneValue) {
    const Levels levels(islands(), {100, 82, 66, 50, 50, 22, 10});
    EXPECT_EQ(levels.level, (Ids{0, 1, 2, 3, 3, 5, 6}));
    EXPECT_EQ(levels.kind[3], merge);
}

// A ring (genus 1) that becomes two spheres at one value: no kind of its own.
TEST(Levels, ThatSplitAndChangeTheGenusAreComplex) {
    const Levels levels(body(), {100, 90, 60, 58, 30, 30, 20});
    EXPECT_EQ(levels.level, (Ids{0, 1, 2, 3, 4, 4, 6}));
    EXPECT_EQ(levels.kind[4], complex);
}

// A hollow ball of one value: no contour in, two out, then only the outer one.
TEST(Levels, OfAPlateauAreOneMaximum) {
    const Levels levels(hollow_ball(), {9, 9, 3});
    EXPECT_EQ(levels.level, (Ids{0, 0, 2}));
    EXPECT_EQ(levels.kind[0], maximum);
    EXPECT_EQ(levels.kind[2], minimum);
}

TEST(Levels, OfAConstantVolumeAreOneMaximum) {
    const Levels levels(body(), {5, 5, 5, 5, 5, 5, 5});
    EXPECT_EQ(levels.level, Ids(7, 0));
    EXPECT_EQ(levels.kind[0], maximum);
}

// Equal values alone do not join: A and B are not on one contour.
TEST(Levels, OfOneValueOnDifferentContoursStayApart) {
    const Levels levels(two_peaks(), {7, 7, 5});
    EXPECT_EQ(levels.level, (Ids{0, 1, 2}));
    EXPECT_EQ(levels.kind, (Kinds{maximum, maximum, merge}));
}

// In 2D contours have no genus: a saddle with one contour in and two out splits.
TEST(Levels, OfIslandsHaveNoGenus) {
    EXPECT_EQ(Levels(islands(), islands().values).kind, (Kinds{maximum, maximum, maximum, merge, merge, split, minimum}));
}

TEST(Levels, ArcsToTheOutsideHaveALength) {
    const ContourTree<Id> tree = two_peaks().contours();
    const std::vector<double> values{7, 5, 5};
    const auto value = by_element(values);
    EXPECT_TRUE(has_length<Id>(tree, value, ElementKey(0)));
    EXPECT_FALSE(has_length<Id>(tree, value, ElementKey(1)));
    EXPECT_TRUE(has_length<Id>(tree, value, ElementKey(2)));
}

}  // namespace
}  // namespace isoatlas
