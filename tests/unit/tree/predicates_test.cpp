// Every predicate holds for the trees of volumes drawn by hand (drawings.h), and says what is wrong with a damaged one.
#include "tree/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/tree/drawings.h"

namespace isoatlas {
namespace {

std::vector<Drawing> all_drawings() { return {two_peaks(), hollow_ball(), islands(), body()}; }

void expect_violation(const Verdict& verdict, const std::string& part) {
    EXPECT_FALSE(verdict);
    EXPECT_NE(verdict.violation().find(part), std::string::npos) << verdict.violation();
}

TEST(ChildrenComeBeforeParents, InJoinTrees) {
    for (const Drawing& drawing : all_drawings()) EXPECT_TRUE(children_come_before_parents<ElementKey>(drawing.join()));
}
TEST(ChildrenComeBeforeParents, UnlessOneDoesNot) {
    expect_violation(children_come_before_parents<ElementKey>(tree_of(Ids{2, 0, 2})), "node 1 has the impossible parent 0");
    expect_violation(children_come_before_parents<ElementKey>(tree_of(Ids{2, 3, 2})), "node 1 has the impossible parent 3");
    expect_violation(children_come_before_parents<ElementKey>(tree_of(Ids{0, 2, 2})), "node 0 has the impossible parent 0");  // two roots
    expect_violation(children_come_before_parents<ElementKey>(tree_of(Ids{2, 2, 1})), "node 2 is the last one but not a root");
    expect_violation(children_come_before_parents<ElementKey>(tree_of(Ids{})), "no root");
}

TEST(IsJoinTree, ForEveryDrawing) {
    for (const Drawing& drawing : all_drawings()) EXPECT_TRUE(is_join_tree<Id>(drawing.join()));
}
TEST(IsJoinTree, UnlessItIsDamaged) {
    expect_violation(is_join_tree<Id>(tree_of(Ids{3, 2, 3, 3})), "the outside has 2 children");
    expect_violation(is_join_tree<Id>(tree_of(Ids{3, 3, 3, 4, 4})), "node 3 has more than two children");
    expect_violation(is_join_tree<Id>(two_peaks().split()), "impossible parent");
}

TEST(IsSplitTree, ForEveryDrawing) {
    for (const Drawing& drawing : all_drawings()) EXPECT_TRUE(is_split_tree<Id>(drawing.split()));
}
TEST(IsSplitTree, UnlessItIsDamaged) {
    expect_violation(is_split_tree<Id>(tree_of(Ids{0, 0, 3, 2})), "node 2 has the impossible parent 3");
    expect_violation(is_split_tree<Id>(tree_of(Ids{0, 0, 0, 0})), "node 0 has more than two children");
    expect_violation(is_split_tree<Id>(body().join()), "node 0 is not a root");
}

TEST(IsContourTree, ForEveryDrawing) {
    for (const Drawing& drawing : all_drawings()) EXPECT_TRUE(is_contour_tree(drawing.contours()));
}
TEST(IsContourTree, UnlessItIsDamaged) {
    const auto damaged = [](Id node, Id other) {
        ContourTree<Id> tree = islands().contours();
        tree.other[ElementKey(node)] = ElementKey(other);
        return is_contour_tree(tree);
    };
    expect_violation(damaged(3, 3), "node 3 has no arc");
    expect_violation(damaged(3, 8), "node 3 has an arc to no node");
    expect_violation(damaged(7, 5), "node 5 has more than two arcs below");
    expect_violation(damaged(0, 4), "node 4 has more than two arcs above");
    expect_violation(damaged(0, 5), "node 3 has another number of arcs");
    ContourTree<Id> tree = body().contours();
    tree.degree[ElementKey(4)] = branches_of(1, 2);
    expect_violation(is_contour_tree(tree), "node 4 has another number of arcs than its degree");
}
//   0 - 1 - outside and 2 = 3: right degrees, but two pieces
TEST(IsContourTree, UnlessItHasACycle) {
    ContourTree<Id> tree;
    for (const Id other : {1, 4, 3, 2, 4}) tree.other.push_back(ElementKey(other));
    for (const auto& [above, below] : {std::pair{0, 1}, {1, 1}, {0, 2}, {2, 0}, {1, 0}}) tree.degree.push_back(branches_of(above, below));
    expect_violation(is_contour_tree(tree), "node 2 lies on a cycle");
}

TEST(EveryArcHasOneContour, OfEveryDrawing) {
    for (const Drawing& drawing : all_drawings())
        EXPECT_TRUE(every_arc_has_one_contour<Id>(drawing.contours(), drawing.join(), drawing.split()));
}
TEST(EveryArcHasOneContour, UnlessTheTreesAreThoseOfDifferentVolumes) {
    const Drawing ring{{peak(0), joins(0, 0), parts(0, 0)}, {9, 6, 3}};
    expect_violation(every_arc_has_one_contour<Id>(hollow_ball().contours(), ring.join(), ring.split()),
                     "below node 1 there are 2 arcs, 1 objects and 1 low components");
    expect_violation(every_arc_has_one_contour<Id>(hollow_ball().contours(), body().join(), body().split()), "different sizes");
}

TEST(EulerNumbersAddUp, ForEveryDrawingIn3D) {
    for (const Drawing& drawing : {two_peaks(), hollow_ball(), body()})
        EXPECT_TRUE(euler_numbers_add_up<Id>(drawing.contours(), drawing.delta_chi()));
}
TEST(EulerNumbersAddUp, UnlessAGenusIsWrong) {
    ContourTree<Id> tree = body().contours();
    tree.half_chi[ElementKey(3)] = 1;  // the ring below the handle becomes a sphere
    expect_violation(euler_numbers_add_up<Id>(tree, body().delta_chi()), "node 3 changes the Euler number by 0, not by -1");
    tree = body().contours();
    tree.half_chi[ElementKey(5)] = 0;  // the box
    expect_violation(euler_numbers_add_up<Id>(tree, body().delta_chi()), "node 5");
}

TEST(EveryLevelHasOneValue, OfEveryDrawing) {
    for (const Drawing& drawing : all_drawings()) {
        for (std::vector<double> values = drawing.values; values.size() > 1; values.pop_back()) {
            std::vector<double> tied = drawing.values;  // from one element on all values are equal
            std::fill(tied.begin() + static_cast<std::ptrdiff_t>(values.size() - 1), tied.end(), values.back());
            EXPECT_TRUE(
                every_level_has_one_value<Id>(drawing.contours(), level_roots<Id>(drawing.contours(), by_element(tied)), by_element(tied)));
        }
    }
}
TEST(EveryLevelHasOneValue, UnlessItIsDamaged) {
    const std::vector<double> values{100, 90, 60, 58, 58, 30, 20};
    const auto check = [&](const Ids& level) {
        return every_level_has_one_value<Id>(body().contours(), tree_of(level), by_element(values));
    };
    EXPECT_TRUE(check({0, 1, 2, 3, 3, 5, 6}));
    expect_violation(check({0, 1, 2, 3, 4, 5, 6}), "has no length and joins two levels");
    expect_violation(check({0, 1, 2, 2, 2, 5, 6}), "element 3 has another value than its level");
    expect_violation(check({0, 1, 2, 4, 4, 5, 6}), "element 3 has the impossible level 4");
    expect_violation(every_level_has_one_value<Id>(two_peaks().contours(), tree_of(Ids{0, 0, 2}), by_element<double>({7, 7, 5})),
                     "2 levels of 3");
}

CriticalityTree<Id> events_of(const Drawing& drawing) {
    const MergeTree<Id> level = level_roots<Id>(drawing.contours(), drawing.value()), join = drawing.join();
    const ByElement<Id, LevelKind> kind = level_kinds<Id>(drawing.contours(), level, drawing.value(), drawing.delta_chi());
    return criticality_tree<Id>(join_groups<Id>(join, drawing.value()), join, level, kind);
}

TEST(EveryEventHasItsZone, OfEveryDrawing) {
    for (const Drawing& drawing : all_drawings()) EXPECT_TRUE(every_event_has_its_zone<Id>(events_of(drawing), drawing.value()));
}
TEST(EveryEventHasItsZone, UnlessItIsDamaged) {
    const std::vector<double> values = body().values;
    CriticalityTree<Id> tree = events_of(body());
    tree.parent[EventKey(4)] = EventKey(3);
    expect_violation(every_event_has_its_zone<Id>(tree, by_element(values)), "node 4 has the impossible parent 3");
    tree = events_of(body());
    tree.event_of_element[ElementKey(3)] = EventKey(5);
    expect_violation(every_event_has_its_zone<Id>(tree, by_element(values)), "event 3 has the highest element of another");
    tree = events_of(body());
    expect_violation(every_event_has_its_zone<Id>(tree, by_element<double>({100, 90, 60, 58, 58, 30, 20})),
                     "element 3 lies outside the zone of its event");
    tree.event_of_element.push_back(EventKey(0));  // an element below its zone
    std::vector<double> more = values;
    more.push_back(10);
    expect_violation(every_event_has_its_zone<Id>(tree, by_element(more)), "element 7 lies outside the zone of its event");
}

}  // namespace
}  // namespace isoatlas
