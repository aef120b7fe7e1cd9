// Contour trees of volumes drawn by hand (drawings.h), made from join and split tree and restored from their arcs alone.
#include "tree/contour_tree.h"

#include <gtest/gtest.h>

#include "tree/arcs_by_runs.h"
#include "tree/split_tree.h"
#include "unit/tree/drawings.h"

namespace isoatlas {
namespace {

using HalfChi = std::vector<std::int32_t>;

std::vector<std::uint8_t> degrees(const std::vector<std::pair<int, int>>& above_and_below) {
    std::vector<std::uint8_t> all;
    for (const auto& [above, below] : above_and_below) all.push_back(branches_of(above, below));
    return all;
}

TEST(ContourTree, OfTwoPeaksIsTheirJoinTree) {
    const ContourTree<Id> tree = two_peaks().contours();
    EXPECT_EQ(list(tree.other), (Ids{2, 2, 3, 3}));
    EXPECT_EQ(list(tree.degree), degrees({{0, 1}, {0, 1}, {2, 1}, {1, 0}}));
    EXPECT_EQ(list(tree.half_chi), (HalfChi{1, 1, 1, 0}));
}

TEST(ContourTree, HasTwoArcsBelowWhereACavityCloses) {
    const ContourTree<Id> tree = hollow_ball().contours();
    EXPECT_EQ(list(tree.other), (Ids{1, 3, 1, 3}));
    EXPECT_EQ(list(tree.degree), degrees({{0, 1}, {1, 2}, {1, 0}, {1, 0}}));
    EXPECT_EQ(tree.upper(ElementKey(2)), ElementKey(1));  // the arc of the minimum runs up
    EXPECT_EQ(tree.lower(ElementKey(2)), ElementKey(2));
    EXPECT_FALSE(tree.has_arc(ElementKey(3)));
}

// A - s1, B - s1, C - s2, s1 - s2, s2 - closes, m - closes, closes - outside: as removed in docs/theory/4-genus.md#the-contour-tree.
TEST(ContourTree, OfIslandsIsThatOfTheTheory) {
    const ContourTree<Id> tree = islands().contours();
    EXPECT_EQ(list(tree.other), (Ids{3, 3, 4, 4, 5, 7, 5, 7}));
    EXPECT_EQ(list(tree.half_chi), HalfChi(8, 0));  // 2D
}

TEST(ContourTree, HasTheGenusOfEveryContour) {
    const ContourTree<Id> tree = body().contours();
    EXPECT_EQ(list(tree.other), (Ids{2, 2, 3, 4, 5, 7, 5, 7}));
    EXPECT_EQ(list(tree.half_chi), (HalfChi{1, 1, 1, 0, 1, 1, 1, 0}));  // 1 - genus: a ring below the handle
}

TEST(ContourTree, IsTheSameWithThreads) {
    const ContourTree<Id> tree = contour_tree<Id>(body().join(), body().split(), body().delta_chi(), 4);
    EXPECT_EQ(list(tree.other), list(body().contours().other));
    EXPECT_EQ(list(tree.half_chi), list(body().contours().half_chi));
}

TEST(ContourTree, IsRestoredFromItsArcs) {
    for (const Drawing& drawing : {two_peaks(), hollow_ball(), islands(), body()}) {
        const ContourTree<Id> tree = drawing.contours();
        ContourTree<Id> restored;
        restored.other = tree.other;
        ASSERT_TRUE(complete_contour_tree<Id>(restored, drawing.delta_chi()));
        EXPECT_EQ(list(restored.degree), list(tree.degree));
        EXPECT_EQ(list(restored.half_chi), list(tree.half_chi));
    }
}

TEST(ContourTree, IsNotRestoredFromWhatIsNotATree) {
    const auto is_restored = [](const Ids& other) {
        ContourTree<Id> tree;
        for (const Id node : other) tree.other.push_back(ElementKey(node));
        return complete_contour_tree<Id>(tree, two_peaks().delta_chi());
    };
    EXPECT_TRUE(is_restored({2, 2, 3, 3}));
    EXPECT_FALSE(is_restored({2, 2, 1, 3}));  // 1 - 2 - 1
    EXPECT_FALSE(is_restored({2, 2, 4, 3}));  // no such node
    EXPECT_FALSE(is_restored({2, 2, 3, 2}));  // the outside has an arc
    EXPECT_FALSE(is_restored({3, 3, 3, 3}));  // three arcs above the outside
    EXPECT_FALSE(is_restored({2, 3, 3, 3}));  // two
    ContourTree<Id> tree;
    tree.other = two_peaks().contours().other;
    EXPECT_FALSE(complete_contour_tree<Id>(tree, by_element(std::vector<std::int8_t>{1, 1, 1})));  // Euler numbers of no box
}

TEST(ContourTree, GivesItsJoinTreeBack) {
    for (const Drawing& drawing : {two_peaks(), hollow_ball(), islands(), body()})
        EXPECT_EQ(list(join_tree_of(drawing.contours())), list(drawing.join()));
}

TEST(ContourTree, GivesItsSplitTreeBack) {
    for (const Drawing& drawing : {two_peaks(), hollow_ball(), islands(), body()})
        EXPECT_EQ(list(split_tree_of(drawing.contours()).parent), list(drawing.split()));
}

// The cavity is that of node 6 at its minimum; the low component of all others holds the outside, node 7.
TEST(SplitTree, NamesTheLowestNodeOfEveryLowComponent) {
    EXPECT_EQ(list(split_tree_of(body().contours()).lowest), (Ids{7, 7, 7, 7, 7, 7, 6, 7}));
}

Ids by_runs(const Drawing& drawing) {
    const ContourTree<Id> tree = drawing.contours();
    ByElement<Id, std::uint8_t> branches(drawing.elements.size());
    for (const ElementKey i : branches.ids()) branches[i] = tree.degree[i];
    return list(arcs_by_runs<Id>(branches, drawing.join(), drawing.split(), 1));
}

//   A - 1 - 2 - 3 - outside: one run
TEST(Runs, DownOneContourHaveTheArcsOfTheContourTree) {
    const Drawing chain{{peak(0), regular(), regular(), regular()}, {9, 8, 7, 6}};
    EXPECT_EQ(by_runs(chain), (Ids{1, 2, 3, 4, 4}));
}

//   A
//   1
//   | `-2 - 3 - m     a run on the wall of the cavity: its arcs lead up, towards the outside
//   outside
TEST(Runs, OnTheWallOfACavityLeadUp) {
    const Drawing cavity{{peak(0), parts(0, 1), regular(0, 1), regular(0, 1), pit(1)}, {9, 8, 7, 6, 5}};
    EXPECT_EQ(by_runs(cavity), (Ids{1, 5, 1, 2, 3, 5}));
}

TEST(Runs, OfDrawingsHaveTheArcsOfTheContourTree) {
    for (const Drawing& drawing : {two_peaks(), hollow_ball(), islands(), body()})
        EXPECT_EQ(by_runs(drawing), list(drawing.contours().other));
}

}  // namespace
}  // namespace isoatlas
