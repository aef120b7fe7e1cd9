// Events of volumes drawn by hand (drawings.h), and what they measure.
#include "tree/criticality_tree.h"
#include "tree/contour_tree.h"

#include <gtest/gtest.h>

#include "unit/tree/drawings.h"

namespace isoatlas {
namespace {

using Numbers = std::vector<std::int32_t>;
using enum Criticality;

struct Events {
    CriticalityTree<Id> tree;
    EventMeasures<Id> measures;

    Events(const Drawing& drawing, const std::vector<double>& values) {
        const ContourTree<Id> contours = drawing.contours();
        const auto value = by_element(values);
        const ByElement<Id, std::int8_t> delta = drawing.delta_chi();
        const MergeTree<Id> join = drawing.join(), level = level_roots<Id>(contours, value);
        const ByElement<Id, LevelKind> kind = level_kinds<Id>(contours, level, value, delta);
        tree = criticality_tree<Id>(join_groups<Id>(join, value), join, level, kind);
        measures = measure_events<Id>(tree, contours, level, kind, delta);
    }
};

TEST(JoinGroups, AreJoinedElementsOfOneValue) {
    EXPECT_EQ(list(join_groups<Id>(islands().join(), islands().value())), (Ids{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(list(join_groups<Id>(islands().join(), by_element<double>({100, 82, 66, 50, 50, 22, 10}))), (Ids{0, 1, 2, 4, 4, 5, 6}));
    EXPECT_EQ(list(join_groups<Id>(two_peaks().join(), by_element<double>({5, 5, 5}))), (Ids{2, 2, 2}));
}

TEST(CriticalityTree, OfDistinctValuesIsTheJoinTree) {
    const Events events(body(), body().values);
    EXPECT_EQ(list(events.tree.top), (Ids{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(list(events.tree.parent), (Ids{2, 2, 3, 4, 5, 6, 6}));
    EXPECT_EQ(list(events.tree.event_of_element), (Ids{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_TRUE(events.tree.is_root(EventKey(6)));
}

// 3 and 4 cancel: the zone of the merge (element 2) goes on below them.
TEST(CriticalityTree, DropsEventsOfTrivialLevels) {
    const Events events(body(), {100, 90, 60, 58, 58, 30, 20});
    EXPECT_EQ(list(events.tree.top), (Ids{0, 1, 2, 5, 6}));
    EXPECT_EQ(list(events.tree.parent), (Ids{2, 2, 3, 4, 4}));
    EXPECT_EQ(list(events.tree.event_of_element), (Ids{0, 1, 2, 2, 2, 3, 4}));
}

//   A
//   1 handle         40
//   2                30    a ring around a cavity
//   |  `-4 minimum     20  the cavity is filled,
//   3 filled         20    and so is the ring: two levels, one event
//   outside
TEST(CriticalityTree, JoinsLevelsOfOneValueInOneObject) {
    const Drawing drawing{{peak(0), joins(0, 0), parts(0, 1), parts(0, 0), pit(1)}, {100, 40, 30, 20, 20}};
    const Events events(drawing, drawing.values);
    EXPECT_EQ(list(events.tree.top), (Ids{0, 1, 2, 3}));
    EXPECT_EQ(list(events.tree.parent), (Ids{1, 2, 3, 3}));
    EXPECT_EQ(list(events.tree.event_of_element), (Ids{0, 1, 2, 3, 3}));
    EXPECT_EQ(list(events.measures.kind), (std::vector{maximum, genus, split, complex}));  // the two levels disagree
    EXPECT_EQ(list(events.measures.contours), (Ids{1, 1, 2, 1}));
    EXPECT_EQ(list(events.measures.chi), (Numbers{1, 0, 1, 1}));
}

//   A
//   1                30
//   | `-3              20    two cavities that are filled at one value
//   2                25
//   | `-4              20
TEST(CriticalityTree, LevelsThatAgreeGiveTheEventTheirKind) {
    const Drawing drawing{{peak(0), parts(0, 1), parts(0, 2), pit(1), pit(2)}, {100, 30, 25, 20, 20}};
    const Events events(drawing, drawing.values);
    EXPECT_EQ(list(events.measures.kind), (std::vector{maximum, split, split, minimum}));
    EXPECT_EQ(list(events.measures.contours), (Ids{1, 2, 3, 1}));
}

TEST(CriticalityTree, OfAConstantVolumeIsOneEvent) {
    const Events events(body(), {5, 5, 5, 5, 5, 5, 5});
    EXPECT_EQ(list(events.tree.top), (Ids{0}));
    EXPECT_EQ(list(events.tree.parent), (Ids{0}));
    EXPECT_EQ(list(events.measures.kind), (std::vector{maximum}));
}

// Two objects of one value are two events.
TEST(CriticalityTree, KeepsObjectsOfOneValueApart) {
    const Events events(two_peaks(), {7, 7, 5});
    EXPECT_EQ(list(events.tree.parent), (Ids{2, 2, 2}));
}

TEST(EventMeasures, AddUpOverTheObject) {
    const Events events(body(), body().values);
    EXPECT_EQ(list(events.measures.delta_chi), (Numbers{1, 1, -1, -1, 1, 1, -1}));
    EXPECT_EQ(list(events.measures.chi), (Numbers{1, 1, 1, 0, 1, 2, 1}));  // a ring below 3, a hollow ball below 5
    EXPECT_EQ(list(events.measures.contours), (Ids{1, 1, 1, 1, 1, 2, 1}));
    EXPECT_EQ(list(events.measures.lows_out), (Ids{1, 1, 1, 1, 1, 2, 0}));
    EXPECT_EQ(list(events.measures.kind), (std::vector{maximum, maximum, merge, genus, genus, split, minimum}));
}

}  // namespace
}  // namespace isoatlas
